#include "stages/glare/psf.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace scotopic {
namespace {

// CIE 135/1:1999 as HDR-VDP's hdrvdp_otf_cie99.m has it; the standard itself was not read. Arias 2018 prints
// 1 - 1.6 a for the veil: a slip of the pen, older eyes scatter more.
// Term of the form amplitude (1 + (theta/width)^2)^-exponent; widths in degrees.
struct Term {
  double amplitude, width, exponent, gamma;  // gamma: Gamma(exponent)
};

const double gamma_half = std::sqrt(std::numbers::pi);
const Term core_narrow = {9.2e6, 0.0046, 1.5, gamma_half / 2};
const Term core_broad = {1.5e5, 0.045, 1.5, gamma_half / 2};
const Term veil_lens = {400, 0.1, 1, 1};
const Term veil_near = {1300, 0.1, 1.5, gamma_half / 2};
const Term veil_far = {0.8, 0.1, 0.5, gamma_half};
constexpr double veil_rise = 3e-8;
constexpr double wall = 0.0025;

// 2 pi times the integrals over sin(theta) d theta, 0 ... 90 degrees, of what each factor of the function
// multiplies: by mpmath to 30 digits, and again by Simpson's rule in asinh(theta) to 15.
constexpr double core_integral = 0.95353168714836177;
constexpr double veil_integral = 0.051303918114115976;
constexpr double pigment_integral = 0.036853413037134946;
constexpr double wall_integral = 2 * std::numbers::pi * wall;

double value(const Term& term, double theta) {
  const double ratio = theta / term.width;
  return term.amplitude * std::pow(1 + ratio * ratio, -term.exponent);
}

// C u^nu e^-u / Gamma(nu): the density of Gaussians over ln u, u = width^2/2 sigma^2.
double density(const Term& term, double sigma) {
  const double u = term.width * term.width / (2 * sigma * sigma);
  return term.amplitude * std::pow(u, term.exponent) * std::exp(-u) / term.gamma;
}

double fourth_power(double x) { return x * x * x * x; }

bool within(double x, double low, double high) { return x >= low && x <= high; }

}  // namespace

GlareFunction::GlareFunction(const GlareEye& eye) {
  if (!within(eye.age, 0, 100)) throw std::invalid_argument("glare: age must be 0 to 100 years");
  if (!within(eye.pigmentation, 0, 1.2)) throw std::invalid_argument("glare: pigmentation must be 0 to 1.2");
  if (!(eye.halo >= 0 && eye.halo < 1)) throw std::invalid_argument("glare: the halo must be 0 to below 1");
  const double aged = fourth_power(eye.age / 70);
  core_ = 1 - 0.08 * aged;
  veil_ = 1 + 1.6 * aged;
  pigmentation_ = eye.pigmentation;
  halo_ = eye.halo;
  normalisation_ = (core_ * core_integral + veil_ * (veil_integral + pigmentation_ * pigment_integral) +
                    pigmentation_ * wall_integral) /
                   (1 - halo_);
}

double GlareFunction::psf(double theta) const noexcept {
  const double core = value(core_narrow, theta) + value(core_broad, theta);
  const double veil =
      value(veil_lens, theta) + pigmentation_ * (value(veil_near, theta) + value(veil_far, theta));
  return (core_ * core + veil_ * veil) / normalisation_ + wide(theta);
}

double GlareFunction::rung(double sigma) const noexcept {
  const double core = density(core_narrow, sigma) + density(core_broad, sigma);
  const double veil =
      density(veil_lens, sigma) + pigmentation_ * (density(veil_near, sigma) + density(veil_far, sigma));
  // An octave of sigma is 2 ln 2 of ln u.
  return 2 * std::numbers::ln2 * (core_ * core + veil_ * veil) / normalisation_;
}

double GlareFunction::wide(double theta) const noexcept {
  return (wall * pigmentation_ + veil_ * veil_rise * theta * theta) / normalisation_;
}

double cie146_veil(double theta, const GlareEye& eye) noexcept {
  return 10 / (theta * theta * theta) +
         (5 / (theta * theta) + 0.1 * eye.pigmentation / theta) * (1 + fourth_power(eye.age / 62.5)) +
         wall * eye.pigmentation;
}

double stiles_holladay_veil(double theta, double age) noexcept {
  return 10 * (1 + fourth_power(age / 70)) / (theta * theta);
}

}  // namespace scotopic

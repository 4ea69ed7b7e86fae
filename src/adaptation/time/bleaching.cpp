#include "adaptation/time/bleaching.h"

#include <cmath>

namespace scotopic {
namespace {

// I/Q, 1/s, under which there is no light: squares of its inverse would overflow.
constexpr double no_light = 1e-100;

// The roots of dB/dt = -a (B - stable) (B - other)/(B + K), a = I/Q.
struct Roots {
  double stable, other;

  Roots(const Pigment& p, double a) noexcept {
    const double q = p.regeneration / a - (1 - p.half_rate);
    const double root = std::sqrt(q * q + 4 * p.half_rate);
    stable = q < 0 ? (root - q) / 2 : 2 * p.half_rate / (q + root);
    other = -p.half_rate / stable;
  }
};

// Root u <= 0 of f, by Newton's method from 0. f rises and is convex or concave throughout, f(0) >= 0: what
// overshoots does so once, and all other steps go one way.
template <typename F>
double newton_below_zero(F value_and_slope) noexcept {
  double u = 0;
  for (int i = 0; i < 100; ++i) {
    const auto [value, slope] = value_and_slope(u);
    const double step = value / slope;
    u -= step;
    if (std::abs(step) <= 1e-15 * std::abs(u)) break;
  }
  return u;
}

struct Value {
  double value, slope;
};

// ln(X/X0) = -V dt/K, solved for u = ln(B/B0).
double after_darkness(const Pigment& p, double bleached, double seconds) noexcept {
  const double w = bleached / p.half_rate;
  const double decay = p.regeneration / p.half_rate * seconds;
  const double u = newton_below_zero([=](double v) {
    return Value{v + w * std::expm1(v) + decay, 1 + w * std::exp(v)};
  });
  return bleached * std::exp(u);
}

// Partial fractions of dt = -(B + K) dB/(a (B - stable) (B - other)), solved for u = ln((B - stable)/(B0 -
// stable)).
double after_light(const Pigment& p, double bleached, double a, double seconds) noexcept {
  const Roots roots(p, a);
  const double apart = roots.stable - roots.other;
  const double near = (roots.stable + p.half_rate) / (a * apart);
  const double far = -(roots.other + p.half_rate) / (a * apart);
  const double from = bleached - roots.stable;
  if (from == 0) return bleached;
  const double u = newton_below_zero([=](double v) {
    const double left = from * std::exp(v);
    return Value{near * v + far * std::log1p(from * std::expm1(v) / (from + apart)) + seconds,
                 near + far * left / (left + apart)};
  });
  return roots.stable + from * std::exp(u);
}

}  // namespace

double bleached_at_equilibrium(const Pigment& pigment, double trolands) noexcept {
  const double a = trolands / pigment.bleaching;
  return a < no_light ? 0 : Roots(pigment, a).stable;
}

double bleached_after(const Pigment& pigment, double bleached, double trolands, double seconds) noexcept {
  if (seconds == 0) return bleached;
  const double a = trolands / pigment.bleaching;
  if (a < no_light) return bleached == 0 ? 0 : after_darkness(pigment, bleached, seconds);
  return after_light(pigment, bleached, a, seconds);
}

double equivalent_background(const Pigment& pigment, double bleached) noexcept {
  const double w = bleached / pigment.half_rate;
  return w * std::exp(w);
}

}  // namespace scotopic

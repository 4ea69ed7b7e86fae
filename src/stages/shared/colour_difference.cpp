#include "stages/shared/colour_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scotopic {
namespace {

constexpr double degree = std::numbers::pi / 180;

double seventh_power_share(double chroma) {
  constexpr double half = 25.0 * 25 * 25 * 25 * 25 * 25 * 25;
  const double c7 = std::pow(chroma, 7);
  return std::sqrt(c7 / (c7 + half));
}

/// 0 to 2 pi; 0 for a neutral.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double h = std::atan2(b, a);
  return h < 0 ? h + 2 * std::numbers::pi : h;
}

/// Difference and mean of two hues along the shorter way round; a neutral has no say.
struct HuePair {
  double difference, mean;
  HuePair(double h1, double h2, bool neutral) {
    difference = neutral ? 0 : h2 - h1;
    mean = neutral ? h1 + h2 : (h1 + h2) / 2;
    if (neutral || std::abs(h1 - h2) <= std::numbers::pi) return;
    difference += difference > 0 ? -2 * std::numbers::pi : 2 * std::numbers::pi;
    mean += h1 + h2 < 2 * std::numbers::pi ? std::numbers::pi : -std::numbers::pi;
  }
};

double size_of(const Vec3<double>& xyz) {
  return std::max({std::abs(xyz[0]), std::abs(xyz[1]), std::abs(xyz[2])});
}

bool finite(const Vec3<double>& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

bool same_kind(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::isinf(a) ? a == b : std::isfinite(b);
}

}  // namespace

Lab lab_from_xyz(const Vec3<double>& xyz, const Vec3<double>& white) noexcept {
  // ISO/CIE 11664-4: cube root above (6/29)^3, its tangent below.
  constexpr double delta = 6.0 / 29;
  const auto f = [](double t) {
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const double x = f(xyz[0] / white[0]), y = f(xyz[1] / white[1]), z = f(xyz[2] / white[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double ciede2000(const Lab& p, const Lab& q) noexcept {
  const double mean_chroma = (std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2;
  const double stretch = 1.5 - 0.5 * seventh_power_share(mean_chroma);  // 1 + G
  const double a1 = stretch * p.a, a2 = stretch * q.a;
  const double c1 = std::hypot(a1, p.b), c2 = std::hypot(a2, q.b);
  const HuePair h(hue(a1, p.b), hue(a2, q.b), c1 * c2 == 0);

  const double dl = q.lightness - p.lightness;
  const double dc = c2 - c1;
  const double dh = 2 * std::sqrt(c1 * c2) * std::sin(h.difference / 2);

  const double l = (p.lightness + q.lightness) / 2 - 50;
  const double c = (c1 + c2) / 2;
  const double t = 1 - 0.17 * std::cos(h.mean - 30 * degree) + 0.24 * std::cos(2 * h.mean) +
                   0.32 * std::cos(3 * h.mean + 6 * degree) - 0.20 * std::cos(4 * h.mean - 63 * degree);
  const double sl = 1 + 0.015 * l * l / std::sqrt(20 + l * l);
  const double sc = 1 + 0.045 * c;
  const double sh = 1 + 0.015 * c * t;
  const double bump = (h.mean / degree - 275) / 25;
  const double turn = -2 * seventh_power_share(c) * std::sin(60 * degree * std::exp(-bump * bump));
  const double x = dl / sl, y = dc / sc, z = dh / sh;
  return std::sqrt(std::max(0.0, x * x + y * y + z * z + turn * y * z));
}

double exposed_difference(const Vec3<double>& reference, const Vec3<double>& other) noexcept {
  if (!finite(reference) || !finite(other)) {
    for (std::size_t i = 0; i < 3; ++i)
      if (!same_kind(reference[i], other[i])) return std::numeric_limits<double>::infinity();
    return 0;
  }
  const Vec3<double>& exposed = size_of(reference) > 0 ? reference : other;
  const double luminance = std::max(exposed[1], size_of(exposed) / 64);
  if (!(luminance > 0)) return 0;
  // Divided first: the factor alone would overflow for the darkest of colours.
  const auto expose = [luminance](const Vec3<double>& v) {
    return Vec3<double>{v[0] / luminance * exposed_luminance, v[1] / luminance * exposed_luminance,
                        v[2] / luminance * exposed_luminance};
  };
  return ciede2000(lab_from_xyz(expose(reference)), lab_from_xyz(expose(other)));
}

double shown_difference(const Vec3<double>& reference, const Vec3<double>& other) noexcept {
  return ciede2000(lab_from_xyz(reference), lab_from_xyz(other));
}

namespace {

/// PQ code (SMPTE ST 2084) of a luminance in units of 100 cd/m2.
double pq_code(double light) {
  constexpr double m1 = 2610.0 / 16384, m2 = 2523.0 / 4096 * 128, c1 = 3424.0 / 4096, c2 = 2413.0 / 4096 * 32,
                   c3 = 2392.0 / 4096 * 32;
  const double y = std::pow(std::clamp(light / 100, 0.0, 1.0), m1);
  return std::pow((c1 + c2 * y) / (1 + c3 * y), m2);
}

Vec3<double> itp_from_xyz(const Vec3<double>& xyz) {
  // BT.2020 RGB from XYZ, and the LMS of BT.2100.
  constexpr Matrix3<double> rgb_from_xyz{{{{1.716651187971268, -0.355670783776392, -0.253366281373660},
                                           {-0.666684351832489, 1.616481236634939, 0.015768545813911},
                                           {0.017639857445311, -0.042770613257809, 0.942103121235474}}}};
  constexpr Matrix3<double> lms_from_rgb{{{{1688.0 / 4096, 2146.0 / 4096, 262.0 / 4096},
                                           {683.0 / 4096, 2951.0 / 4096, 462.0 / 4096},
                                           {99.0 / 4096, 309.0 / 4096, 3688.0 / 4096}}}};
  Vec3<double> lms = lms_from_rgb * (rgb_from_xyz * xyz);
  for (double& x : lms) x = pq_code(x);
  const double i = (lms[0] + lms[1]) / 2;
  const double ct = (6610 * lms[0] - 13613 * lms[1] + 7003 * lms[2]) / 4096;
  const double cp = (17933 * lms[0] - 17390 * lms[1] - 543 * lms[2]) / 4096;
  return {i, ct / 2, cp};
}

}  // namespace

double itp_difference(const Vec3<double>& reference, const Vec3<double>& other) noexcept {
  const Vec3<double> a = itp_from_xyz(reference), b = itp_from_xyz(other);
  return 720 * std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace scotopic

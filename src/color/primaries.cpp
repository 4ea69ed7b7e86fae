#include "color/primaries.h"

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

constexpr Xy d65 = white_d65;
// The white of ST 2065-1: close to, but not, CIE D60.
constexpr Xy aces_white{0.32168, 0.33767};
constexpr Matrix3<double> bradford_cones{
    {{{.8951, .2664, -.1614}, {-.7502, 1.7135, .0367}, {.0389, -.0685, 1.0296}}}};
constexpr double chromaticity_tolerance = 1e-3;
constexpr double matrix_tolerance = 5e-4;

Vec3<double> xyz_of_white(Xy white) { return {white.x / white.y, 1.0, (1.0 - white.x - white.y) / white.y}; }

bool close(Xy a, Xy b) {
  return std::abs(a.x - b.x) <= chromaticity_tolerance && std::abs(a.y - b.y) <= chromaticity_tolerance;
}

double largest_difference(const Matrix3<double>& a, const Matrix3<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) worst = std::max(worst, std::abs(a[i][j] - b[i][j]));
  return worst;
}

/// Von Kries in a cone-like space: XYZ under white `from` to XYZ under white `to`.
Matrix3<double> adapted(const Matrix3<double>& cone, Xy from, Xy to) {
  const Vec3<double> a = cone * xyz_of_white(from);
  const Vec3<double> b = cone * xyz_of_white(to);
  return inverse(cone) * (diagonal<double>({b[0] / a[0], b[1] / a[1], b[2] / a[2]}) * cone);
}

}  // namespace

const std::vector<NamedPrimaries>& known_primaries() {
  static const std::vector<NamedPrimaries> sets = {
      {"rec709", "Linear Rec.709 (sRGB)", {{.640, .330}, {.300, .600}, {.150, .060}, d65}},
      {"rec2020", "Linear Rec.2020", {{.708, .292}, {.170, .797}, {.131, .046}, d65}},
      {"p3", "Linear P3-D65", {{.680, .320}, {.265, .690}, {.150, .060}, d65}},
      {"ap1", "ACEScg", {{.713, .293}, {.165, .830}, {.128, .044}, aces_white}},
      {"ap0", "ACES2065-1", {{.7347, .2653}, {.0, 1.0}, {.0001, -.0770}, aces_white}},
  };
  return sets;
}

bool are_usable(const Primaries& p) {
  const auto finite = [](Xy c) { return std::abs(c.x) <= 10 && std::abs(c.y) <= 10; };
  if (!finite(p.red) || !finite(p.green) || !finite(p.blue) || !finite(p.white) || !(p.white.y > 1e-3))
    return false;
  const double area =
      (p.green.x - p.red.x) * (p.blue.y - p.red.y) - (p.blue.x - p.red.x) * (p.green.y - p.red.y);
  if (!(std::abs(area) > 1e-4)) return false;
  // A white far from all that counts as one excites a cone negatively: nothing adapts to it.
  for (const double cone : bradford_cones* xyz_of_white(p.white))
    if (!(cone > 0)) return false;
  const Matrix3<double> m = xyz_d65_from_rgb(p);
  return std::abs(determinant(m)) > 1e-6 && std::isfinite(determinant(m));
}

Matrix3<double> xyz_from_rgb(const Primaries& p) {
  const auto column = [](Xy c) { return Vec3<double>{c.x, c.y, 1.0 - c.x - c.y}; };
  const Matrix3<double> directions =
      transpose(Matrix3<double>{{column(p.red), column(p.green), column(p.blue)}});
  const Vec3<double> amounts = inverse(directions) * xyz_of_white(p.white);
  return directions * diagonal(amounts);
}

Matrix3<double> bradford(Xy from, Xy to) { return adapted(bradford_cones, from, to); }

Matrix3<double> cat02(Xy from, Xy to) {
  constexpr Matrix3<double> cone{{{{.7328, .4296, -.1624}, {-.7036, 1.6975, .0061}, {.0030, .0136, .9834}}}};
  return adapted(cone, from, to);
}

Matrix3<double> xyz_d65_from_rgb(const Primaries& p) {
  const bool is_d65 = p.white.x == d65.x && p.white.y == d65.y;
  return is_d65 ? xyz_from_rgb(p) : bradford(p.white, d65) * xyz_from_rgb(p);
}

std::optional<Matrix3<double>> gamut_xyz_matrix(std::string_view name) {
  for (const NamedPrimaries& set : known_primaries())
    if (set.name == name) return xyz_d65_from_rgb(set.primaries);
  return std::nullopt;
}

const Primaries& cie_xyz_primaries() {
  static const Primaries xyz = {{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}};
  return xyz;
}

bool are_cie_xyz(const Primaries& p) {
  const Primaries& q = cie_xyz_primaries();
  return close(p.red, q.red) && close(p.green, q.green) && close(p.blue, q.blue) && close(p.white, q.white);
}

bool is_cie_xyz(const Matrix3<double>& m) {
  return largest_difference(m, identity3<double>()) <= matrix_tolerance;
}

const NamedPrimaries* match_primaries(const Primaries& p) {
  for (const NamedPrimaries& set : known_primaries()) {
    const Primaries& q = set.primaries;
    if (close(p.red, q.red) && close(p.green, q.green) && close(p.blue, q.blue) && close(p.white, q.white))
      return &set;
  }
  return nullptr;
}

bool same_matrix(const Matrix3<double>& a, const Matrix3<double>& b) {
  return largest_difference(a, b) <= matrix_tolerance;
}

const NamedPrimaries* match_matrix(const Matrix3<double>& m) {
  for (const NamedPrimaries& set : known_primaries())
    if (same_matrix(m, xyz_d65_from_rgb(set.primaries))) return &set;
  return nullptr;
}

}  // namespace scotopic

// What properties of pixels are stated in: bits, sizes, distances, luminance, and what counts as light.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stages/limits.h"
#include "properties/property.h"
#include "support/primaries.h"

namespace scotopic::test {

using Rgb = std::array<float, 3>;

inline std::array<std::uint32_t, 3> bits(const Rgb& v) {
  return std::bit_cast<std::array<std::uint32_t, 3>>(v);
}
inline std::array<std::uint64_t, 3> bits(const Vec3<double>& v) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(v);
}

template <typename V>
double largest(const V& v) {
  double out = 0;
  for (const auto x : v) out = std::max(out, std::abs(static_cast<double>(x)));
  return out;
}

inline double distance(const Vec3<double>& a, const Vec3<double>& b) {
  return largest(Vec3<double>{a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

inline double luminance(const AppearanceReference& op, const Vec3<double>& rgb) {
  return dot(op.constants().luminance_from_rgb, rgb);
}

inline double local_luminance(const AppearanceReference& op, const Vec3<double>& rgb) {
  return local_luminance(op.constants(), rgb);
}

/// A light: no component and no cone signal negative, and luminance not under 1/64 of the cone signals,
/// white's being 1.
inline bool is_light(const Case& c, double least_luminance = luminance_floor) {
  const OperatorConstants constants(c.parameters);
  const Vec3<double> rgb = {c.sample.rgb[0], c.sample.rgb[1], c.sample.rgb[2]};
  const auto q = constants.lms_from_rgb * rgb;
  const double y = dot(constants.luminance_from_rgb, rgb);
  for (std::size_t i = 0; i < 3; ++i)
    if (rgb[i] < 0 || q[i] <= 0 || y < least_luminance * q[i] / constants.cone_white[i]) return false;
  return largest(rgb) <= operable_limit && largest(rgb) > 1e-30;
}

/// Spaces an image may come in, of D65 white: BT.709, BT.2020, ACEScg, and an AP0-like one with imaginary
/// primaries.
struct WorkingSpace {
  const char* name;
  Matrix3<double> xyz_from_rgb;
};
inline constexpr std::array<WorkingSpace, 4> working_spaces = {
    {{"rec709", rec709},
     {"rec2020", rec2020},
     {"acescg", xyz_from_rgb({0.713, 0.165, 0.128}, {0.293, 0.830, 0.044}, 0.3127, 0.3290)},
     {"ap0", xyz_from_rgb({0.7347, 0.0, 0.0001}, {0.2653, 1.0, -0.077}, 0.3127, 0.3290)}}};

/// Each working space in at least a fifth of the checks; add what else must be covered.
inline Shares all_working_spaces(Shares more = {}) {
  for (const auto& space : working_spaces) more.emplace_back(space.name, 0.2);
  return more;
}

inline const WorkingSpace& any_space(Random& random) {
  return working_spaces[static_cast<std::size_t>(random.below(4))];
}

inline const std::vector<Regime> no_light = {Regime::subnormal, Regime::tiny, Regime::huge};

}  // namespace scotopic::test

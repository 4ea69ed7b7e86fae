// What properties of pixels are stated in: bits, sizes, distances, luminance, and what counts as light.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "appearance/stages.h"
#include "properties/property.h"

namespace scotopic::test {

using Rgb = std::array<float, 3>;

inline std::array<std::uint32_t, 3> bits(const Rgb& v) { return std::bit_cast<std::array<std::uint32_t, 3>>(v); }
inline std::array<std::uint64_t, 3> bits(const Vec3<double>& v) { return std::bit_cast<std::array<std::uint64_t, 3>>(v); }

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
  const auto& p = op.constants().parameters;
  return p.adaptation + (p.weight == Weight::local ? std::max(0.0, luminance(op, rgb) * p.white_luminance) : 0.0);
}

/// A light: no component and no cone signal negative, and luminance not under 1/64 of the cone signals, white's being 1.
inline bool is_light(const Case& c) {
  const OperatorConstants constants(c.parameters);
  const Vec3<double> rgb = {c.sample.rgb[0], c.sample.rgb[1], c.sample.rgb[2]};
  const auto q = constants.lms_from_rgb * rgb;
  const double y = dot(constants.luminance_from_rgb, rgb);
  for (std::size_t i = 0; i < 3; ++i)
    if (rgb[i] < 0 || q[i] <= 0 || y < luminance_floor * q[i] / constants.cone_white[i]) return false;
  return largest(rgb) <= operable_limit && largest(rgb) > 1e-30;
}

inline const std::vector<Regime> no_light = {Regime::subnormal, Regime::tiny, Regime::huge};

}  // namespace scotopic::test

// A pixel's light inside a display's gamut, and how bright it is against the scene's adaptation.
#pragma once

#include <algorithm>
#include <cmath>

#include "stages/shared/projection.h"
#include "stages/limits.h"
#include "stages/display/local/display.h"
#include "receptors/receptor_space.h"

namespace scotopic {

/// Decades of luminance over La between which a base layer is told apart: six below, fourteen above.
inline constexpr float darkest_decade = -6.0f;
inline constexpr float brightest_decade = 14.0f;

/// Immutable: share it between threads.
class GamutLight {
 public:
  /// Works out its matrices once.
  explicit GamutLight(const DisplayParameters& p)
      : gamut_from_rgb_((inverse(p.xyz_from_gamut) * p.xyz_from_rgb).to<float>()),
        rgb_from_gamut_((inverse(p.xyz_from_rgb) * p.xyz_from_gamut).to<float>()),
        same_(p.xyz_from_gamut.rows == p.xyz_from_rgb.rows),
        luminance_{static_cast<float>(p.xyz_from_gamut[1][0]), static_cast<float>(p.xyz_from_gamut[1][1]),
                   static_cast<float>(p.xyz_from_gamut[1][2])},
        per_adaptation_(static_cast<float>(p.white_luminance / p.adaptation)),
        projection_(lms_from_xyz() * p.xyz_from_gamut) {}

  /// False for a pixel that passes as it is.
  static bool operable(const Vec3<float>& rgb) noexcept {
    constexpr auto limit = static_cast<float>(operable_limit);
    return std::abs(rgb[0]) <= limit && std::abs(rgb[1]) <= limit && std::abs(rgb[2]) <= limit;
  }

  /// The nearest colour, in LMS, that the gamut holds: its linear RGB, none below 0.
  Vec3<float> inside(const Vec3<float>& rgb) const noexcept {
    return projection_.nearest(same_ ? rgb : gamut_from_rgb_ * rgb);
  }
  /// Linear working RGB from the gamut's.
  Vec3<float> working(const Vec3<float>& gamut_rgb) const noexcept {
    return same_ ? gamut_rgb : rgb_from_gamut_ * gamut_rgb;
  }
  /// Y, image units.
  float luminance(const Vec3<float>& gamut_rgb) const noexcept { return dot(luminance_, gamut_rgb); }

  /// log10 of luminance over La, within the two decades above.
  float decades(float luminance) const noexcept {
    return std::clamp(std::log10(std::max(luminance * per_adaptation_, 1e-37f)), darkest_decade,
                      brightest_decade);
  }
  /// Luminance, image units, of `decades` over La.
  float luminance_of(float decades) const noexcept { return std::pow(10.0f, decades) / per_adaptation_; }

 private:
  Matrix3<float> gamut_from_rgb_, rgb_from_gamut_;
  bool same_;
  Vec3<float> luminance_;
  float per_adaptation_;
  GamutProjection<float> projection_;
};

}  // namespace scotopic

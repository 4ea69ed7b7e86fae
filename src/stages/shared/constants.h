// Everything about the operator that does not depend on the pixel, in double.
#pragma once

#include <optional>

#include "adaptation/closed_forms.h"
#include "kernel/kernel.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// Colours whose luminance is less than this share of their largest cone signal (white: 1) are no light -
/// noise, or another gamut's remnants - and are scaled by a regularised ratio. A 450 nm laser has .02.
inline constexpr double luminance_floor = 1.0 / 64;

/// Half-saturation luminance of s(L) = L/(L + .108), chroma against luminance (Wanat & Mantiuk 2014,
/// "Simulating and compensating changes in appearance between day and night vision", fitted there to contrast
/// matching).
inline constexpr double chroma_half_luminance = 0.108;

/// What every pixel shares: matrices, whites, effective strengths, worked out once.
struct OperatorConstants {
  /// From parameters inside their domains.
  explicit OperatorConstants(const AppearanceParameters& parameters);

  AppearanceParameters parameters;
  Kernel<double> kernel;         ///< takes luminance units of 1 cd/m2
  double kernel_scale;           ///< T, kernel units per luminance unit
  Matrix3<double> lms_from_rgb;  ///< luminance units per image value 1, that is per white_luminance
  Matrix3<double> rgb_from_lms;
  Vec3<double> luminance_from_rgb;  ///< Y row of xyz_from_rgb
  Vec3<double> cone_white;          ///< q of image white (1, 1, 1)
  double rod_white;                 ///< r of a D65 white of luminance 1, as the rod estimate in use gives it
  double shift, luminance, chroma;  ///< strengths of the stages; 0: off, as all are at mix 0
  double mix;                       ///< share of the result in what comes out; the rest is the input
  Matrix3<double> gamut_from_rgb;   ///< of the projection's gamut; identity if none
  Matrix3<double> rgb_from_gamut;
  bool project;
  bool gamut_is_rgb;  ///< the gamut is that of the RGB given: no change of primaries
};

/// T of the kernel: what one luminance unit is in the preset's own units, with the eye adapted to
/// `adaptation` cd/m2. V: see adaptation/closed_forms.h.
template <class V>
V kernel_scale_at(const AppearanceParameters& p, const V& adaptation) {
  switch (p.model) {
    case Model::kirk2011:
    case Model::cao2008:
      return closed_forms::trolands_per_luminance(adaptation);
    case Model::safko2019:
      return p.safko_scale;
    case Model::filament2021:
      break;
  }
  return filament2021_scale;
}

/// The thesis' way back to XYZ: inverse of CAT02 on peak-1 cone signals ("the matrix defined in CIECAM02").
/// Result: linear RGB from LMS in luminance units, for Model::safko2019 alone.
Matrix3<double> rgb_from_lms_cat02(const AppearanceParameters& parameters);

/// s(L)/s(5), clamped to 1; to 4 ulp.
template <typename T>
T chroma_factor(T local_luminance) noexcept {
  constexpr T half = static_cast<T>(chroma_half_luminance);
  constexpr T at_5 = static_cast<T>(5 / (5 + chroma_half_luminance));
  const T s = local_luminance / (local_luminance + half) / at_5;
  return s < T(1) ? s : T(1);
}

}  // namespace scotopic

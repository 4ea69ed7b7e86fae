// Light as an eye sees it that is used to a lamp's colour: before the receptors.
#pragma once

#include "adaptation/chromatic_adaptation.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// A lamp that the eye is used to.
struct Lamp {
  Vec3<double> white = adapted_white;  ///< XYZ, any scale; Y > 0
  double surround = average_surround;  ///< F of CIECAM02

  /// Its chromaticity.
  double x() const noexcept { return white[0] / (white[0] + white[1] + white[2]); }
  double y() const noexcept { return white[1] / (white[0] + white[1] + white[2]); }
};

/// How far the eye is used to it, 0 to 1: CIECAM02's degree at La, times the strength of all.
double lamp_degree(const Lamp& lamp, const AppearanceParameters& parameters) noexcept;

/// The matrix on XYZ; exactly the identity for D65, and where nothing of the lamp is got used to.
Matrix3<double> lamp_matrix(const Lamp& lamp, const AppearanceParameters& parameters) noexcept;

/// Whether any light changes.
bool changes_light(const Lamp& lamp, const AppearanceParameters& parameters) noexcept;

/// `seen`, linear RGB of luminances `y_row`, faded to its own grey until it is as far outside the gamut as
/// `in` was: what a matrix takes out of the gamut keeps its luminance.
Vec3<double> faded(const Vec3<double>& seen, const Vec3<double>& in, const Vec3<double>& y_row) noexcept;

/// The stage on linear RGB.
class LampOnRgb {
 public:
  LampOnRgb(const Lamp& lamp, const AppearanceParameters& parameters) noexcept;
  Vec3<double> operator()(const Vec3<double>& rgb) const noexcept { return faded(rgb_ * rgb, rgb, y_row_); }

 private:
  Matrix3<double> rgb_;
  Vec3<double> y_row_;
};

}  // namespace scotopic

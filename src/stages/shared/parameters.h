// What the appearance operator is told: every choice a user can make, with its default. Plain data.
#pragma once

#include <optional>

#include "kernel/matrix3.h"
#include "kernel/preset.h"
#include "receptors/rods.h"

namespace scotopic {

/// Photographic middle grey: the reflectance that a scene's log-average is taken to be.
inline constexpr double middle_grey = 0.18;

/// Whether rods take part by the luminance at each pixel, La + Y, or by La alone.
enum class Weight { local, global };
/// What luminance a pixel gets: that of MES2, the photopic one it came with, or the kernel's own.
enum class LuminancePolicy { mesopic, photopic, none };

/// Strength of each effect, 0 (off, costs nothing) to 1 (the model). `all` mixes result and input, in linear
/// light: (1 - all) in + all out, so that a slider is monotone.
struct Strengths {
  double all = 1.0;
  double shift = 1.0;
  double luminance = 1.0;
  double chroma = 1.0;
};

/// The operator, whole. Outside the stated domains results are undefined; programs check first.
struct AppearanceParameters {
  Model model = Model::filament2021;
  /// La, the luminance the eye is adapted to, cd/m2; > 0 and finite.
  double adaptation = 0.1;
  /// cd/m2 that image value 1 stands for (the "unit"); > 0 and finite.
  double white_luminance = 0.1 / 0.18;
  /// L_r, cd/m2: what rods are adapted to where that is not La, as after other light
  /// (adaptation/time/dark_adaptation.h).
  std::optional<double> rod_adaptation;
  Weight weight = Weight::local;
  LuminancePolicy luminance = LuminancePolicy::mesopic;
  Strengths strength;
  RodEstimate rods = RodEstimate::linear;
  /// Scotopic over photopic luminance of the scene's illuminant; used only where rods come from colour.
  double sp_ratio = sp_ratio_d65;
  /// Trolands per cd/m2 for Model::safko2019 (the thesis leaves its scale to the user); ignored otherwise.
  double safko_scale = 1.0;
  /// CIE XYZ (D65 white, Y = 1 for RGB 1,1,1) from the linear RGB that the operator is given.
  Matrix3<double> xyz_from_rgb = identity3<double>();
  /// The same for the gamut that results are projected into; nullopt: no projection.
  std::optional<Matrix3<double>> xyz_from_gamut;
};

}  // namespace scotopic

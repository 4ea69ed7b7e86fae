// The constants of the rod-intrusion kernel, one set per publication.
#pragma once

#include "kernel/matrix3.h"

namespace scotopic {

/// Publications whose constants are here.
enum class Model {
  filament2021,  ///< Cao-consistent constants as in Filament's ColorGrading: mild, in gamut; the default
  kirk2011,      ///< Kirk & O'Brien, "Perceptually Based Tone Mapping for Low-Light Conditions" (2011)
  safko2019,     ///< the same constants, on a scale the user chooses (Safko, thesis, Prague 2019)
  cao2008,       ///< kirk2011 with rod input by local luminance (kernel/rod_input.h)
};

/// What tells one kernel from another. `opponent` is N in  Δo = N g R  with Δo = (red-green, blue-yellow,
/// luminance), R the rod signal and g = (1 + max(0, gain (q + kappa R)))^-1/2, all per cone.
struct KernelPreset {
  Vec3<double> kappa;
  Vec3<double> gain;
  Matrix3<double> opponent;
};

/// A of the thesis: opponent signals (red-green, blue-yellow, luminance) from L, M, S.
inline constexpr Matrix3<double> opponent_from_lms{{{{-1, 1, 0}, {-1, -1, 1}, {1, 1, 0}}}};

namespace detail {

constexpr KernelPreset make_kirk2011() {
  // Kirk & O'Brien 2011, section 3, with the fits of Cao et al. 2008: rod input strength kappa, cone maxima
  // m, relative contributions rho and alpha, and the scalings x, y, z that they fitted to hue-matching data.
  constexpr double kappa1 = 0.25, kappa2 = 0.40;
  constexpr double l = 0.637, m = 0.392, s = 1.606;
  constexpr double rho1 = 1.111, rho2 = 0.939, rho3 = 0.400, rho4 = 0.150, alpha = 0.619;
  constexpr double x = 15, y = 15, z = 5;
  return {{kappa1, kappa1, kappa2},
          {0.33, 0.33, 0.33},
          {{{{-x * kappa1 * rho2 / l, x * kappa1 * rho1 / m, 0},
             {-y * rho4 * alpha / l, -y * rho4 * (1 - alpha) / m, y * rho3 / s},
             {z * alpha / l, z * (1 - alpha) / m, 0}}}}};
}

constexpr KernelPreset make_filament2021() {
  // google/filament, ColorGrading.cpp, scotopicAdaptation: K, S, k3, rw, p and the cone maxima m.
  constexpr Vec3<double> m = {0.63721, 0.39242, 1.6064};
  constexpr Vec3<double> kappa = {0.2, 0.2, 0.3};
  constexpr double big_k = 45, big_s = 10, k3 = 0.6, rw = 0.139, p = 0.6189;
  constexpr Matrix3<double> pathways{
      {{{-(k3 + rw), 1 + k3 * rw, 0}, {p * k3, (1 - p) * k3, 1}, {p * big_s, (1 - p) * big_s, 0}}}};
  return {
      kappa,
      {0.33 / m[0], 0.33 / m[1], 0.33 / m[2]},
      (big_k / big_s) * (pathways * diagonal<double>({kappa[0] / m[0], kappa[1] / m[1], kappa[2] / m[2]}))};
}

}  // namespace detail

/// filament2021: kernel units per cd/m2; 380 x 52.3313, the spot-meter anchor of its author.
inline constexpr double filament2021_scale = 19885.9;

/// Constants of a model. safko2019 has those of kirk2011: what differs is the scale, and all around the
/// kernel. So has cao2008, whose kappa is what its own is relative to.
constexpr KernelPreset kernel_preset(Model model) {
  return model == Model::filament2021 ? detail::make_filament2021() : detail::make_kirk2011();
}

}  // namespace scotopic

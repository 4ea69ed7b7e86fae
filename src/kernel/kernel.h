// The rod-intrusion kernel: how far rods move what the cones signal. Pure arithmetic on one pixel.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/preset.h"

namespace scotopic {

/// A preset at one scale, in the number type that it is evaluated in.
///
/// `scale` is T, kernel units (trolands for the published models) per luminance unit. With R = T max(0, r):
///   g  = (1 + max(0, gain (T q + kappa R)))^-1/2      (the clamp: the formula as printed is NaN below -3.03)
///   Δq = A^-1 N g R / T
/// T cancels outside the root, so that Δq neither overflows nor loses digits for any scale.
template <typename T>
class Kernel {
 public:
  /// `scale` is T, > 0 and finite.
  Kernel(const KernelPreset& preset, double scale) noexcept
      : kappa_{to_t(preset.kappa)},
        gain_{to_t({preset.gain[0] * scale, preset.gain[1] * scale, preset.gain[2] * scale})},
        cone_shift_{(inverse(opponent_from_lms) * preset.opponent).to<T>()} {}

  /// Gains g in (0, 1] of the three cone pathways, to 3 ulp. q, r: cone and rod signals in luminance units.
  Vec3<T> gains(const Vec3<T>& q, T r) const noexcept {
    const T rod = std::max(T(0), r);
    Vec3<T> g;
    for (std::size_t i = 0; i < 3; ++i)
      g[i] = T(1) / std::sqrt(T(1) + std::max(T(0), gain_[i] * (q[i] + kappa_[i] * rod)));
    return g;
  }

  /// Δq, what the rods add to (L, M, S), in luminance units. Exactly 0 for r <= 0; finite for finite input,
  /// homogeneous of degree 1 as q, r -> 0 and of degree 1/2 as they grow. Double: relative error < 1e-15 of
  /// each of the (at most three) terms summed per cone.
  Vec3<T> shift(const Vec3<T>& q, T r) const noexcept {
    const T rod = std::max(T(0), r);
    const Vec3<T> g = gains(q, rod);
    return cone_shift_ * Vec3<T>{g[0] * rod, g[1] * rod, g[2] * rod};
  }

  /// As in the preset.
  const Vec3<T>& kappa() const noexcept { return kappa_; }
  /// Gain times T: per luminance unit.
  const Vec3<T>& gain() const noexcept { return gain_; }
  /// Δq = cone_shift() (g r).
  const Matrix3<T>& cone_shift() const noexcept { return cone_shift_; }

 private:
  static Vec3<T> to_t(const Vec3<double>& v) noexcept {
    return {static_cast<T>(v[0]), static_cast<T>(v[1]), static_cast<T>(v[2])};
  }

  Vec3<T> kappa_;
  Vec3<T> gain_;           // gain times scale: per luminance unit
  Matrix3<T> cone_shift_;  // A^-1 N
};

}  // namespace scotopic

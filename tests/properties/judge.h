// One pixel judged: how far each way of computing it is from exact arithmetic, and what is allowed.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "properties/mpfr_reference.h"
#include "properties/regimes.h"

namespace scotopic::test {

enum class Way { reference, single, dual, count };
inline constexpr std::array<const char*, 3> way_names = {"reference", "single", "dual"};

/// Error of a result: largest difference of a component, over the pixel's largest component, in (the receptor
/// signals given among them) or out. Floats below 2^-126 are evenly spaced: there the difference is over
/// `least`, 2^-126 for one rounding, 2^-120 where each stage rounds. Infinite where a result is not finite.
template <typename Real>
double relative_error(const Vec3<double>& got, const Vec3<Real>& exact, const Sample& in, Planes planes,
                      Way way);

/// The same component by component: each difference over the sum of |terms| that the component is made of, so
/// that a small component beside a large one counts. Floats below `least` as above.
double component_error(const Vec3<double>& got, const Summed<long double>& exact, Way way);

/// The largest component that came in, the receptor signals given among them.
double size_in(const Sample& sample, Planes planes);

/// What a pixel asks of the arithmetic: nothing where it passes as it is (from 5 cd/m2 on, or beyond 2^120).
struct Strain {
  /// Condition of the kernel's root: how many times larger than in q and r a relative error is in
  /// 1 + gain T (q + kappa r). About 1 for light; 1e6 and more where rods cancel a negative cone signal to
  /// 2^-20 of its terms; 0 where the sum is further below 0, hence clamped whatever its last digits.
  double root = 0;
  /// Luminance, or a cone signal, is the rest of a cancellation of RGB: no colour of light.
  bool cancelled = false;
};
Strain strain(const OperatorConstants& constants, const Sample& sample, Planes planes);

/// Allowed for a way and a pixel. In double 2e-13, and 2^-47 of the root's condition; 1e-7 and 2^-44 of it
/// for a cancelled pixel: of floats, 2^24 times its luminance may cancel. reference: that; dual: one rounding
/// to float more. single: 2e-6; 4e-6 with quadratic rods, whose polynomial cancels to a tenth in the reds;
/// 8e-6 for a cancelled pixel.
double allowed_error(Way way, RodEstimate rods, const Strain& strain);

/// The part of it that double has, whatever the way.
double allowed_in_double(const Strain& strain);

/// Allowed for component_error, in regimes of light, for all but one in a million; for that one ten times as
/// much: a component that the gamut leaves a small rest of has no bound of its own.
double allowed_component_error(Way way);

/// A setting with all three ways of computing.
struct Evaluators {
  explicit Evaluators(const AppearanceParameters& parameters)
      : reference(parameters), single(parameters, Precision::single), dual(parameters, Precision::dual) {}
  AppearanceReference reference;
  AppearanceBatch single, dual;
};

/// The worst pixel of one regime by one way; every pixel's error in a histogram of octaves of 2^-60.
struct Worst {
  double error = -1;
  double component = 0;  // the worst component_error, of pixels that are not cancelled
  Planes planes = Planes::rgb;
  std::string setting;
  Sample sample;
  std::array<long, 64> octaves{};
};

std::string to_text(Regime regime, Way way, const Worst& worst);

/// A line of worst.csv.
struct Kept {
  Regime regime;
  Way way;
  Planes planes;
  double error;
  Sample sample;
  AppearanceParameters parameters;
};
std::vector<Kept> read_worst(const std::string& path);

}  // namespace scotopic::test

// The appearance operator, one pixel at a time in double: written to be read, and what every faster way is
// held to.
#pragma once

#include <optional>

#include "stages/shared/constants.h"
#include "stages/shared/stage_constants.h"

namespace scotopic {

/// One pixel: its colour, and its receptor signals where they are known.
struct ReferencePixel {
  Vec3<double> rgb{};                   ///< linear, in units of white_luminance
  std::optional<Vec3<double>> cones{};  ///< (L, M, S), luminance units per image unit; absent: from rgb
  std::optional<double> rod{};          ///< likewise; absent: estimated from rgb
};

/// Any rgb is accepted; a component (of any signal given) that is not finite, or beyond operable_limit, makes
/// the pixel pass unchanged. Else continuous (C0) in rgb and in La. Black stays black. What La >= 5 cd/m2 or
/// Lloc >= 5 cd/m2 leaves alone is returned bit for bit. Error against exact arithmetic: 2e-13 of the pixel's
/// largest component, in or out; 1e-8 where rods cancel a negative cone signal under the kernel's root
/// (tests/properties).
class AppearanceReference {
 public:
  /// Parameters are taken to lie in their domains.
  explicit AppearanceReference(const AppearanceParameters& parameters);

  /// The pixel as it is seen: linear RGB, in units of white_luminance.
  Vec3<double> operator()(const ReferencePixel& pixel) const noexcept;

  /// All that does not depend on the pixel.
  const OperatorConstants& constants() const noexcept { return c_; }

 private:
  OperatorConstants c_;
  StageConstants<double> k_;
  StageSwitches on_;
};

/// r in luminance units per image unit, from linear RGB; never negative.
double rod_signal_from_rgb(const OperatorConstants& constants, const Vec3<double>& rgb) noexcept;

/// Factor that takes a colour of luminance `from` to `to` at constant chromaticity:
///   max(0, u to/f + (1 - u^2)),  f = max(|from|, luminance_floor * largest),  u = from/f,
/// largest: the greatest |cone signal| relative to white's, of the pixel as it came in or as it is about to
/// be scaled (what is left of a cancellation has no chromaticity to keep). That is to/from wherever |from| is
/// at least that floor (neutrals, lights, all that a gamut holds); below, continuous, 1 when to = from, and
/// at most |to|/(luminance_floor * largest) + 1. A luminance that would change sign becomes 0. Black (largest
/// = 0): 1. Never over 1e18, which only black with a rod signal of its own could ask for.
double luminance_ratio(double from, double to, double largest) noexcept;

}  // namespace scotopic

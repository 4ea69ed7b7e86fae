// Inputs by regime: where a formula for light is likely to break, each regime drawn on purpose and by name.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "batch/batch.h"
#include "stages/reference.h"

namespace scotopic::test {

/// SplitMix64 (Steele, Lea & Flood 2014): the same draws on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform(double from, double to);
  double log_uniform(double from, double to);
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  bool chance(double p) { return uniform(0, 1) < p; }
  double sign() { return chance(0.5) ? -1 : 1; }

 private:
  std::uint64_t state_;
};

enum class Regime {
  ordinary,       ///< 1e-6 to 1e6 cd/m2, positive
  zero,           ///< +0 and -0, alone or mixed with light
  subnormal,      ///< below 1.2e-38
  tiny,           ///< 1e-38 to 1e-20
  huge,           ///< 1e20 to the largest float; 2^120, beyond which pixels pass as they are, to a few ulp
  half_extremes,  ///< 65504, 6e-8, 6.1e-5: the ends of the half type
  grey,           ///< equal components
  opponent_zero,  ///< L - M cancels, to a few ulp
  pure_rods,      ///< rod signals without cones, or the dimmest cones
  one_channel,    ///< a single primary
  negative,       ///< noise around black
  out_of_gamut,   ///< one component below 0: another gamut's colours
  threshold_photopic,  ///< Lloc around 5 and 4.998 cd/m2, to a few ulp
  threshold_scotopic,  ///< Lloc around .005 and the end of MES2 at .0020 and .001 cd/m2, to a few ulp
  threshold_floor,     ///< luminance around 1/64 of the largest cone signal, half of them to a few ulp
  luminance_zero,      ///< luminance the rest of a cancellation, of any size or around 5 cd/m2
  kernel_clamp,        ///< cone + kappa rod around 0, where the root's argument is clamped; half to a few ulp
  projection_face,     ///< a component around 0, of the input or, to a few ulp, of the shifted colour
  mixed_exponents,     ///< components of unrelated size
  equal_cones,         ///< L = M = S
  count
};
inline constexpr int regime_count = static_cast<int>(Regime::count);
const char* name(Regime regime);
std::optional<Regime> regime_named(const std::string& name);

/// Which planes a call is given beside RGB.
enum class Planes { rgb, rgb_rod, all };

/// One pixel as the batch takes it: numbers of type float.
struct Sample {
  std::array<float, 3> rgb{};
  std::array<float, 3> cones{};
  float rod = 0;

  ReferencePixel widened(Planes planes) const;
};

/// Pixels as planes, and the operator applied to a copy of them.
struct Rows {
  std::vector<float> r, g, b, l, m, s, rod;
  explicit Rows(const std::vector<Sample>& samples);
  PixelRows view(Planes planes);
  std::array<float, 3> rgb(std::size_t i) const { return {r[i], g[i], b[i]}; }
};

/// Places where a formula changes, or a sum cancels.
enum class Threshold {
  photopic,
  mesopic_high,
  mesopic_published,
  mesopic_low,
  mesopic_below,  // Lloc 5, 4.998, .005, .00203, .001 cd/m2
  opponent,
  equal_cones,
  floor,
  clamp,
  face,
  operable,
  count
};
inline constexpr int threshold_count = static_cast<int>(Threshold::count);
const char* name(Threshold threshold);

/// La + max(0, Y), cd/m2, or La alone.
double local_luminance(const OperatorConstants& constants, const Vec3<double>& rgb);

/// Whether a sample, with or without its receptor planes, lies within 8 ulp of float: 2^-20 of what is summed
/// there.
bool is_at(Threshold threshold, const OperatorConstants& constants, const Sample& sample, Planes planes);

AppearanceParameters draw_parameters(Random& random);
Planes draw_planes(Random& random);
Sample draw(Regime regime, const OperatorConstants& constants, Random& random);

/// A setting in one line of text, numbers in hexadecimal, and back: for pixels kept in worst.csv.
std::string to_text(const AppearanceParameters& parameters);
AppearanceParameters parameters_from_text(const std::string& text);

}  // namespace scotopic::test

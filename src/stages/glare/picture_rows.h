// Rows of a picture: what scatters of them, and what they are once it has. Vectorised, the same on every
// instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "stages/glare/pyramid/rows.h"

namespace scotopic::glare {

/// Which light scatters. v = max(R, G, B); above: the share max(0, v - t)/v of each plane; all: all.
enum class GlareShare { above, all };
struct Excess {
  GlareShare share;
  float threshold;
  int planes;                            ///< that scatter
  std::array<float, most_light> less{};  ///< c of each plane: the excess of a flat picture is 0
};

/// A row of the picture: what decides, and what scatters; `light` may be the same planes.
struct PictureRow {
  std::array<const float*, 3> rgb;
  std::array<float*, most_light> light;
};

/// How many pixels are finite and have v > threshold. Pixels beyond 2^120 count as not finite, everywhere
/// here.
std::ptrdiff_t count_above(const PictureRow& row, float threshold, int width);
/// At least the greatest component of every finite pixel of a row, and 0: nothing of it is above a threshold
/// that this is not above.
float greatest_of_row(const std::array<const float*, 3>& rgb, int width);
/// Samples of a row are lit, or not, so many at a time.
inline constexpr int lit_step = 64;
/// out[k] = excess of plane k, 0 where not finite; out[planes] = 1 where finite, else 0. Samples 0 ... width
/// - 1, and rubbish beyond. lit[i] = whether any excess is not 0 from sample i lit_step on. True where all
/// pixels are finite.
bool excess_row(const Excess& excess, const PictureRow& row, float* const* out, std::uint8_t* lit, int width);
/// Least and greatest of samples 0 ... width - 1 of a row whose mask is not 0; of none: infinity and its
/// negative.
std::pair<float, float> extremes_of_row(const float* row, const float* mask, int width);
/// light = (p - e) + e (1 - km) + ke, or p as it is where e and ke are both 0 or the pixel is not finite.
/// e[planes] is the mask, ke[planes] the blurred mask km; with a halo km is ke[planes] + ke[planes + 1 + k]
/// of plane k, else those are null.
void scatter_row(const Excess& excess, const PictureRow& row, const float* const* e, const float* const* ke,
                 int width);

}  // namespace scotopic::glare

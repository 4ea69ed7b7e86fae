// What is added to a value before it is rounded to one of 256 codes, so that slow gradients of a night do not
// step.
#pragma once

#include <cstdint>

namespace scotopic {

/// Codes, within +-0.499, evenly spread: a value that lies on a code keeps it, and the mean of an area is the
/// value's. By the pixel's place alone: the same for every channel, frame, tile and thread. The R2 sequence
/// of M. Roberts (2018, "The unreasonable effectiveness of quasirandom sequences"), folded so that it has no
/// edge.
constexpr float dither_of(int x, int y) noexcept {
  // 2^32 / g and 2^32 / g^2, g^3 = g + 1.
  const std::uint32_t u =
      static_cast<std::uint32_t>(x) * 3242174889u + static_cast<std::uint32_t>(y) * 2447445414u;
  const std::uint32_t folded = u < 0x80000000u ? u : ~u;
  return (static_cast<float>(folded >> 8) * 0x1p-23f - 0.5f) * 0.998f;
}

}  // namespace scotopic

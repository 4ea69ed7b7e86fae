// Pixels that lie in somebody else's memory, in rows of any strides.
#pragma once

#include <cstddef>

namespace scotopic {

/// Number type of a sample.
enum class SampleType { half, float32, float64 };

/// Bytes of one.
std::size_t size_of(SampleType type) noexcept;

/// R, G, B or R, G, B, A of width x height pixels, the topmost row first. Strides in bytes; they may be
/// negative, and need not be multiples of a sample's size.
struct MemoryPixels {
  std::byte* data = nullptr;
  int width = 0;
  int height = 0;
  int channels = 3;
  std::ptrdiff_t row_stride = 0;
  std::ptrdiff_t pixel_stride = 0;
  std::ptrdiff_t channel_stride = 0;
  SampleType type = SampleType::float32;

  /// Row `y` of a channel from column `x` on.
  std::byte* at(int x, int y, int channel) const noexcept {
    return data + y * row_stride + x * pixel_stride + channel * channel_stride;
  }
};

}  // namespace scotopic

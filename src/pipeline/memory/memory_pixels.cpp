#include "pipeline/memory/memory_pixels.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace scotopic {
namespace {

/// First byte and the one after the last.
std::pair<std::uintptr_t, std::uintptr_t> extent(const MemoryPixels& p) {
  std::ptrdiff_t least = 0, greatest = 0;
  const std::pair<int, std::ptrdiff_t> steps[] = {
      {p.width, p.pixel_stride}, {p.height, p.row_stride}, {p.channels, p.channel_stride}};
  for (const auto& [count, stride] : steps) {
    least += std::min<std::ptrdiff_t>(0, (count - 1) * stride);
    greatest += std::max<std::ptrdiff_t>(0, (count - 1) * stride);
  }
  const auto origin = reinterpret_cast<std::uintptr_t>(p.data);
  return {origin + static_cast<std::uintptr_t>(least),
          origin + static_cast<std::uintptr_t>(greatest) + size_of(p.type)};
}

}  // namespace

std::size_t size_of(SampleType type) noexcept {
  return type == SampleType::half ? 2 : type == SampleType::float32 ? 4 : 8;
}

bool same_place(const MemoryPixels& a, const MemoryPixels& b) noexcept {
  return a.data == b.data && a.type == b.type && a.width == b.width && a.height == b.height &&
         a.channels == b.channels && a.row_stride == b.row_stride && a.pixel_stride == b.pixel_stride &&
         a.channel_stride == b.channel_stride;
}

bool overlap(const MemoryPixels& a, const MemoryPixels& b) noexcept {
  const auto [a_first, a_end] = extent(a);
  const auto [b_first, b_end] = extent(b);
  return a_first < b_end && b_first < a_end;
}

}  // namespace scotopic

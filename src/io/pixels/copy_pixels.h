// Pixels that go from file to file as they are.
#pragma once

#include <cstring>

#include "io/pixels/pixel_type.h"

namespace scotopic {

/// The very bytes of all pixels; both rows have the same type.
inline void copy_pixels(const NativeRow& from, std::size_t count, const NativeRow& to) {
  const std::size_t size = size_of(from.type);
  const auto packed = static_cast<std::ptrdiff_t>(size);
  if (from.stride == packed && to.stride == packed) {
    std::memcpy(to.data, from.data, count * size);
    return;
  }
  const std::byte* source = from.data;
  std::byte* target = to.data;
  for (std::size_t i = 0; i < count; ++i, source += from.stride, target += to.stride)
    std::memcpy(target, source, size);
}

}  // namespace scotopic

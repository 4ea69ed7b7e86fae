// Where pixels in memory lie to each other.
#pragma once

#include "scotopic/image.h"

namespace scotopic {

/// Whether both are the very same samples.
bool same_place(const MemoryPixels& a, const MemoryPixels& b) noexcept;
/// Whether any byte may belong to both.
bool overlap(const MemoryPixels& a, const MemoryPixels& b) noexcept;

}  // namespace scotopic

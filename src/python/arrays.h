// numpy arrays as pixels in memory: no copy, any strides.
#pragma once

#include <pybind11/numpy.h>

#include "pipeline/memory/memory_pixels.h"

namespace scotopic {

/// Of an array (height, width, 3 or 4) of float16, float32 or float64; ValueError for any other.
MemoryPixels pixels_of(const pybind11::array& array);

}  // namespace scotopic

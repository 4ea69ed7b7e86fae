// The stages' formulas, written down.
#pragma once

#include <array>

#include "shaders/record/recorded.h"
#include "shaders/shader.h"
#include "shaders/sliders.h"

namespace scotopic::shaders {

/// What comes out for a pixel, as nodes of `graph`.
struct Record {
  Graph graph;
  std::array<int, 3> out{};
  SliderValues defaults{};
};

/// Runs the formulas of pixel_stages-inl.h, and of the display stage where the spec has one, on Recorded
/// numbers.
Record record_of(const ShaderSpec& spec);

}  // namespace scotopic::shaders

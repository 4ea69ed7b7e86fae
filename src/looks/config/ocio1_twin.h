// The looks for programs with OpenColorIO 1: a config of profile 1, whose LUTs are .spi1d and .spi3d.
#pragma once

#include <string>
#include <vector>

#include "looks/config/look_set.h"

namespace scotopic {

/// The config and its files.
struct Ocio1Twin {
  std::string config;
  std::vector<TextFile> luts;
};

/// The chain of each spec of the first one's model that is not an identity, in transforms that OpenColorIO 1
/// has, with 17 nodes a side. It has no range transform: a NaN stays one, and colours outside AP1 are clamped
/// less neatly. Displays: sRGB alone.
Ocio1Twin make_ocio1_twin(const std::vector<LookSpec>& specs, const std::string& search_path);

}  // namespace scotopic

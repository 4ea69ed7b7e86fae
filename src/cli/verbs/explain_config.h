// explain CONFIG: what each look of an OCIO config does.
#pragma once

#include <string>
#include <vector>

#include "color/colour_config.h"

namespace scotopic {

struct ExplainedLook {
  std::string name;
  std::string description;  ///< the config's own, first line
  std::string does;         ///< "nothing", "one matrix", "a 3D LUT of 33 nodes a side between 8 other steps"
};

/// The looks in the config's order, each as OCIO would run it, optimised. A look that cannot be made into a
/// processor says why in `does`.
std::vector<ExplainedLook> explain_looks(const ColourConfig& config);

}  // namespace scotopic

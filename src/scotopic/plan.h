// What a scene calls for, and why.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace scotopic {

/// Whether one stage runs.
struct PlannedStage {
  std::string name;     ///< as --effects has it
  bool asked = false;   ///< by the parameters
  bool needed = false;  ///< the scene calls for it
  bool runs = false;    ///< asked and needed
  double number = 0;    ///< what decided, in `unit`
  double threshold = 0;
  std::string unit;
  std::string reason;  ///< one sentence holding number and threshold
  double share = 0;    ///< of pixels that it touches, 0 to 1, as far as it is known
};

/// The numbers of a scene, and its stages in the order in which light passes.
struct Plan {
  double adaptation = 0;       ///< luminance the eye is adapted to, cd/m2
  double white_luminance = 0;  ///< cd/m2 of image value 1
  std::string adaptation_source, white_luminance_source;
  std::vector<PlannedStage> stages;

  /// Pixels come out as they went in, but for what a display or a colour space asks.
  bool nothing() const {
    return std::none_of(stages.begin(), stages.end(), [](const PlannedStage& s) { return s.runs; });
  }
};

}  // namespace scotopic

// Stage `time`, described: adaptation/time/dark_adaptation.h computes it.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr StageParameter time_parameters[] = {
    {"fps", "frames a second", 0, 1e6, 0, "Of a sequence (default 0: the file's framesPerSecond, else 24)"}};
inline constexpr StageDescription time_description = {"time",
                                                      "",
                                                      "Time",
                                                      StageSupport::pixel,
                                                      "RGB, the adaptation's state",
                                                      "RGB as an eye sees it that is still adapting",
                                                      "the eye is adapted",
                                                      "the state changes from frame to frame",
                                                      "--adaptation-history",
                                                      time_parameters};

}  // namespace scotopic

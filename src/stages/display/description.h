// Stage `display`, described.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr std::string_view visibility_words[] = {"hdrvdp2", "ward1997"};
inline constexpr StageParameter display_parameters[] = {
    {"visibility", "", 0, 1, 0, "What just visible means: hdrvdp2 (default) or ward1997", visibility_words},
    {"viewing-adaptation", "cd/m2", 1e-3, 1e5, 18, "What eyes at the display are adapted to (default 18)"},
    {"peak", "cd/m2", 1, 1e5, 100, "Greatest luminance of the display (default 100)"},
    strength_of("strength-display", "How much of the dimming is shown (default 1)")};
inline constexpr StageDescription display_description = {"display",
                                                         "",
                                                         "Display",
                                                         StageSupport::pixel,
                                                         "RGB of the scene",
                                                         "RGB of the display, 1 its peak",
                                                         "scale 1 and below half the peak",
                                                         "",
                                                         "--display",
                                                         display_parameters};

}  // namespace scotopic

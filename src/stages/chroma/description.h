// Stage `chroma`, described.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr StageParameter chroma_parameters[] = {
    strength_of("strength-chroma", "Of the loss of colour, 0 to 1")};
inline constexpr StageDescription chroma_description = {"chroma",
                                                        "",
                                                        "What is seen",
                                                        StageSupport::pixel,
                                                        "RGB, Lloc",
                                                        "RGB faded towards its luminance",
                                                        "Lloc >= 5 cd/m2",
                                                        "",
                                                        "",
                                                        chroma_parameters};

}  // namespace scotopic

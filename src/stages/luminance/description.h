// Stage `luminance`, described.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr StageParameter luminance_parameters[] = {
    strength_of("strength-luminance", "Of the luminance policy, 0 to 1")};
inline constexpr StageDescription luminance_description = {"luminance",
                                                           "",
                                                           "What is seen",
                                                           StageSupport::pixel,
                                                           "RGB, luminance, rods, m(Lloc)",
                                                           "RGB scaled to the policy's luminance",
                                                           "Lloc >= 5 cd/m2, or policy none",
                                                           "",
                                                           "",
                                                           luminance_parameters};

}  // namespace scotopic

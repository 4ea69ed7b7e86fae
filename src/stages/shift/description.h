// Stage `shift`, described.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr StageParameter shift_parameters[] = {
    strength_of("strength-shift", "Of the rods' colour shift, 0 to 1")};
inline constexpr StageDescription shift_description = {"shift",
                                                       "",
                                                       "What is seen",
                                                       StageSupport::pixel,
                                                       "RGB, cones' and rods' signals, m(Lloc)",
                                                       "RGB with the rods' share, inside the gamut",
                                                       "Lloc >= 5 cd/m2",
                                                       "",
                                                       "",
                                                       shift_parameters};

}  // namespace scotopic

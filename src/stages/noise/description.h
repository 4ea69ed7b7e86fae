// Stage `noise`, described.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr StageParameter noise_parameters[] = {
    strength_of("strength-noise", "Of the rods' noise, 0 to 1"),
    {"seed", "", 0, 9007199254740992.0, 0, "Which noise it is: a whole number (default 0)", {}, {}, true}};
inline constexpr StageDescription noise_description = {
    "noise",
    "",
    "Noise",
    StageSupport::pixel,
    "RGB, rods' signal, Lloc, place, time",
    "RGB as few photons let it flicker",
    "fluctuations are below 10 % there: from 0.003 cd/m2 up everywhere",
    "it differs from place to place and from frame to frame",
    "",
    noise_parameters};

}  // namespace scotopic

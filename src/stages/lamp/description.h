// Stage `lamp`, described: stages/lamp/lamp.h computes it.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr std::string_view surround_words[] = {"average", "dim", "dark"};
inline constexpr StageParameter lamp_parameters[] = {
    {"surround", "", 0, 2, 0,
     "How far an eye gets used to a lamp's colour: average (default), dim, dark (CIECAM02)", surround_words}};
inline constexpr StageDescription lamp_description = {
    "lamp",
    "",
    "Lamp",
    StageSupport::pixel,
    "RGB, cones' signals",
    "the same, as an eye sees them that is used to the lamp's colour",
    "no lamp is told, or it is D65",
    "",
    "--adapt-white",
    lamp_parameters};

}  // namespace scotopic

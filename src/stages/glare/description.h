// Stage `glare`, described.
#pragma once

#include "stages/description.h"

namespace scotopic {

inline constexpr std::string_view glare_words[] = {"above", "all", "none"};
inline constexpr StageParameter glare_parameters[] = {
    {"glare", "", 0, 2, 0,
     "What the eye scatters: above (default: light the display cannot show), above:T (image units), all (the "
     "image on the retina, to measure), none",
     glare_words},
    {"glare-threshold", "image units", 0, 1e30, 0,
     "Light from here on scatters (default 0: what the display cannot show)"},
    {"age", "years", 0, 100, 28.58, "Of the eye (default 28.58)"},
    {"pigmentation", "", 0, 1.2, 0.5, "Of the eye: 0 black, 0.5 brown (default), 1 blue, 1.2 very light"},
    {"glare-halo", "", 0, 1, 0,
     "Ring of 3 degrees around lamps, of the lens's fibres, at pupils above 3 mm: 0 none (default), 1 the "
     "strongest that is seen"},
    strength_of("strength-glare", "Of the scattered light, 0 to 1")};
inline constexpr StageDescription glare_description = {
    "glare",
    "",
    "Glare",
    StageSupport::frame,
    "RGB, or cones' and rods' signals",
    "the same, with a halo around lamps",
    "no pixel is brighter than the threshold, or no veil is 1 % of a pixel's light",
    "it needs the whole picture, which no LUT sees",
    "",
    glare_parameters};

}  // namespace scotopic

// Stage `detail`, described. Two filters compute it: contrast/ and acuity/.
#pragma once

#include "stages/description.h"

namespace scotopic {

/// In the order of detail_words.
enum class DetailFilter { contrast, bilateral, bilateral_local, none };

inline constexpr std::string_view detail_words[] = {"contrast", "bilateral", "bilateral-local", "none"};
inline constexpr std::string_view acuity_space_words[] = {"light", "lab"};
inline constexpr std::string_view acuity_quality_words[] = {"draft", "normal", "fine"};
inline constexpr StageParameter detail_parameters[] = {
    {"detail", "", 0, 3, 0,
     "What dim light takes away: contrast (default: weak contrasts, the finer the more), bilateral (detail "
     "under "
     "the eye's acuity), bilateral-local (less around lamps), none",
     detail_words},
    {"strength-detail", "", 0, 1, 1, "Of the loss of detail, 0 to 1", {}, "strength-acuity"},
    {"acuity-space", "", 0, 1, 0, "Bilateral: what is averaged: light (default) or lab", acuity_space_words},
    {"acuity-range", "CIELAB units", 0.1, 1000, 15,
     "Bilateral: differences that count as edges (default 15)"},
    {"acuity-quality", "", 0, 2, 1, "Bilateral: draft, normal (default), fine", acuity_quality_words}};
inline constexpr StageDescription detail_description = {"detail",
                                                        "acuity",
                                                        "Detail",
                                                        StageSupport::neighbourhood,
                                                        "RGB",
                                                        "RGB without the detail that is not seen",
                                                        "what is around it is not dim, or flat",
                                                        "it needs a pixel's neighbours, which no LUT sees",
                                                        "",
                                                        detail_parameters};

}  // namespace scotopic

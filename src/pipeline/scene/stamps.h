// What an output says of how it was made.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings.h"

namespace scotopic {

/// The attribute that carries an output's provenance: a digest of what it was made from.
inline constexpr const char* provenance_attribute = "scotopic:provenance";

/// Of the pixel stages and the scene.
std::vector<Attribute> parameter_stamps(const AppearanceParameters& scene, const OperatorChoice& choice,
                                        const ImageLayout& layout);

/// Of stamps that tell how light was seen, those that still hold for what a display or another device is
/// sent.
void correct_stamps(std::vector<Attribute>& stamps, const DisplayChoice& choice, const ImageLayout& layout);

}  // namespace scotopic

// Colour management of OpenFX 1.5: what the host says of the source's colour space, and what it is told of
// the output's. Identifiers are those of style Core, of the API's own config (its name: api.h).
#pragma once

#include <optional>
#include <string>

#include "color/colour_config.h"
#include "ofx/suites.h"

namespace scotopic::ofx {

/// $OCIO's, else the project's own, read once; nullopt where that fails, which an operator tells.
const std::optional<ColourConfig>& config_in_force();

/// A host that offers colour management is told that the plug-in takes identifiers of style Core.
void describe_colour(const Properties& effect);

/// What host and plug-in have agreed upon for an instance.
enum class ColourStyle { none, basic, core };
ColourStyle colour_style(const Properties& instance);

/// The config's space for an identifier; empty: the working space, which stands for any scene-linear one.
/// Error(config) where its values are no colours, or are decoded by nothing that is known.
std::string space_for(const std::string& identifier, const ColourConfig& config);

/// The identifier of a space that results are in; in style basic, and where Core has none, that of its kind.
std::string identifier_of(const ColourSpace& space, const ColourConfig& config, ColourStyle style);

}  // namespace scotopic::ofx

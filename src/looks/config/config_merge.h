// Looks added to a studio's own config, the rest of it left as it is.
#pragma once

#include <string>
#include <vector>

#include "looks/config/look_config.h"
#include "color/colour_config.h"

namespace scotopic {

/// A studio's config with looks in it.
struct MergedConfig {
  std::string text;        ///< the whole new config
  std::string lut_folder;  ///< where the looks' files go: a folder "scotopic" on the config's search path
  bool rewritten = false;  ///< the text had to be written anew by OCIO: comments and layout are lost
};

/// Adds looks, colour spaces and, for each display, views like its first picture view with the look. Lines
/// are only inserted (and active_views gets longer); that nothing else changed is verified by OCIO's reading
/// of both. `entries`: files named without folder. Error(config) names what clashes, or what the config
/// lacks.
MergedConfig merge_looks(const ColourConfig& config, std::vector<LookEntry> entries);

/// What changed, as unified diff without context; `before` and `after` differ by insertions and changed lines
/// only.
std::string line_diff(const std::string& before, const std::string& after);

}  // namespace scotopic

// Looks added to a studio's own config, the rest of it left as it is.
#pragma once

#include <string>
#include <vector>

#include "color/colour_config.h"
#include "looks/config/look_config.h"
#include "looks/config/look_set.h"

namespace scotopic {

/// A view that was added to a display.
struct AddedView {
  std::string display;
  std::string view;
};

/// A studio's config with looks in it.
struct MergedConfig {
  std::string text;        ///< the whole new config
  std::string lut_folder;  ///< where the looks' files go: a folder "scotopic" on the config's search path
  bool rewritten = false;  ///< the text had to be written anew by OCIO: comments and layout are lost
  std::vector<AddedView> views;                ///< on displays that have one that loads
  std::vector<std::string> unproven_displays;  ///< that got views, too, like one of theirs that does not load
};

/// Adds looks, colour spaces and, for each display, views like its first that shows a picture, with the look:
/// to the display's own or to the shared ones, wherever that one is. Lines are only inserted (and
/// active_views, the displays' lists of shared views and an empty search_path get longer); that nothing else
/// changed is verified by OCIO's reading of both. `entries`: files named without folder. Error(config) names
/// what clashes, or what the config lacks.
MergedConfig merge_looks(const ColourConfig& config, std::vector<LookEntry> entries);

/// Throws Error(config) where OCIO, reading merged.text, cannot make one of the set's looks, colour spaces or
/// views: with the looks as they were baked, whose files need not be there yet.
void require_all_load(const MergedConfig& merged, const ColourConfig& config, const LookSet& set);

}  // namespace scotopic

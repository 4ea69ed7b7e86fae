// Views with looks, put where a config keeps views like them.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <string>
#include <vector>

#include "looks/merge/config_lines.h"
#include "looks/merge/config_merge.h"

namespace scotopic {

/// To each display of the config, for each entry with `view`, a view like the first one there that shows a
/// picture and loads (else the first that shows a picture), the look behind those it has, but for one that an
/// earlier merge put there. Like a shared view: a shared view, where most displays' first ones are the same;
/// the display's own elsewhere. Fills merged.views and merged.unproven_displays.
AddedViews add_views(OCIO_NAMESPACE::Config& config, const std::string& working_space,
                     const std::vector<LookEntry>& entries, MergedConfig& merged);

}  // namespace scotopic

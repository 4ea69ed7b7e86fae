// Active displays that a config does not have.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

namespace scotopic {

/// Of a config that is not valid, takes from active_displays those names that no display has: OpenColorIO's
/// validation refuses the whole config for one (filmic-blender has such), its hosts do not ask for it. A list
/// of nothing else stays.
void forget_lost_displays(OCIO_NAMESPACE::Config& config);

}  // namespace scotopic

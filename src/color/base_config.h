// The project's own OpenColorIO config, made in code: spaces, roles, displays; looks are added by the bake
// room.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

namespace scotopic {

/// A valid, editable config of profile version 2.0. Scene reference ACES2065-1, display reference
/// CIE-XYZ-D65, scene_linear = "Linear Rec.709 (sRGB)"; names as in the ACES configs. Each display has a view
/// "Un-tone-mapped" and a view "Raw". "CIE XYZ-D65" is scene-referred XYZ, D65-adapted (Bradford), RGB white
/// at Y = 1.
OCIO_NAMESPACE::ConfigRcPtr make_base_config();

}  // namespace scotopic

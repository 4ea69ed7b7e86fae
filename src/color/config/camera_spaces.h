// Camera and grading encodings of the own config: log curves of the makers, as the ACES configs name them.
#pragma once

#include <OpenColorIO/OpenColorIO.h>

namespace scotopic {

/// Adds the log spaces of ARRI, Apple, Blackmagic Design, Canon, Panasonic, RED and Sony, and ACEScc and
/// ACEScct. Each goes to the scene reference ACES2065-1 by OpenColorIO's own transform where 2.1 has one,
/// else by its maker's formula. Names and aliases are those of the OpenColorIO ACES configs 4.0, with `ocio:`
/// identifiers also without that namespace. Codes 0 to 1 come back to 1e-6 (Canon: OpenColorIO's table of
/// 4096 entries; Apple Log: from code 0 = light -0.0564 on).
void add_camera_spaces(OCIO_NAMESPACE::Config& config);

}  // namespace scotopic

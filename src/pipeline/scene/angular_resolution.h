// How large a pixel is to the viewer.
#pragma once

#include <string>

#include "io/pixel_source.h"
#include "pipeline/settings.h"

namespace scotopic {

/// --ppd, else --fov, else the camera's 35 mm equivalent focal length in the file, else 60: a display on
/// which a pixel is one arc minute.
AngularResolution angular_resolution(const ViewingChoice& choice, const PixelSource& source,
                                     const ImageLayout& layout);

/// Whether its left side lies beside its right one: --projection, else what the file says.
bool is_panorama(const ViewingChoice& choice, const PixelSource& source, const ImageLayout& layout);

}  // namespace scotopic

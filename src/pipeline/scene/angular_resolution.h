// How large a pixel is, and the acuity filter that follows from it.
#pragma once

#include <memory>
#include <string>

#include "io/pixel_source.h"
#include "pipeline/notes.h"
#include "pipeline/settings.h"

namespace scotopic {

/// --ppd, else --fov, else the camera's 35 mm equivalent focal length in the file, else 60: a display on
/// which a pixel is one arc minute.
AngularResolution angular_resolution(const AcuityChoice& choice, const PixelSource& source,
                                     const ImageLayout& layout);

/// Whether its left side lies beside its right one: --projection, else what an EXR's envmap says.
bool is_panorama(const AcuityChoice& choice, const PixelSource& source, const ImageLayout& layout);

/// The filter of a scene, for a plan that runs it.
std::unique_ptr<SpatialFilter> acuity_filter(const AcuityChoice& choice, const AppearanceParameters& scene,
                                             const AngularResolution& resolution, const Notes& notes);

}  // namespace scotopic

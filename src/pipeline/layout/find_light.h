// Which of a file's subimages are light, and whose colours they are.
#pragma once

#include "pipeline/layout/layout.h"

namespace scotopic {

struct FoundLight {
  std::vector<LightSubimage> light;  ///< at least one
  std::vector<std::string> notes;    ///< what is left alone
};

/// By the rules of find_colour() in each subimage. Parts whose names are those of data, or whose
/// colorInteropID says so, are none. Of several parts the views of a stereo pair are all light, else the one
/// with the name of a beauty. `request.layer` may be a layer, a part or a view. Throws Error for none, and
/// for several without a choice.
FoundLight find_light(const PixelSource& source, const ColourConfig& config, const ImageRequest& request);

}  // namespace scotopic

// Filters on a tile of an image: a pixel whose halo the tile holds becomes what it is in the image.
#pragma once

#include "pipeline/rows/stages.h"

namespace scotopic {

/// The stages for an image at `data`, a tile of one at `whole`, that does not wrap. Pixels whose halo the
/// tile does not hold pass as they are.
FilterStages stages_on_tile(const FilterStages& stages, const Window& data, const Window& whole);

}  // namespace scotopic

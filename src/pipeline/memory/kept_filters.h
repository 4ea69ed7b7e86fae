// Filters that are made once, however often their settings meet the same scene: a host asks tile by tile.
#pragma once

#include "pipeline/rows/stages.h"

namespace scotopic {

/// The stages of one ImageSettings; each keeps the filter that it made last, with what it said, and hands it
/// out again while La, unit and resolution are the same. For an eye that still adapts it makes a new one.
/// Any number of threads at once.
FilterStages kept_filters(const FilterStages& stages);

}  // namespace scotopic

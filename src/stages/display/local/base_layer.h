// What the base layer is made with; for the files of this room alone.
#pragma once

#include "stages/acuity/filter.h"
#include "stages/display/local/display.h"
#include "stages/display/local/gamut_light.h"

namespace scotopic {

/// The light it works in, and the filter.
struct BaseLayer::Plan {
  /// Parameters are taken to lie in their domains.
  explicit Plan(const DisplayParameters& parameters);

  /// Fills tile.r with the base layer, in decades over La (NaN where the pixel is no number); g and b are
  /// lost.
  void decades(const AcuityWindow& window, const AcuityTile& tile, const ParallelFor& parallel_for) const;

  GamutLight light;
  AcuityFilter filter;
};

}  // namespace scotopic

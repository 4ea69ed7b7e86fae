// A subimage's light from the top, row by row, for whoever only looks at it.
#pragma once

#include <utility>

#include "io/pixel_source.h"
#include "io/pixels/row_bands.h"
#include "pipeline/layout/layout.h"
#include "pipeline/rows/row_codec.h"

namespace scotopic {

/// Calls `work(row)` with every row of the first of the layout's subimages with light, as linear working RGB.
template <typename Work>
void each_light_row(PixelSource& source, const ImageLayout& layout, const ColourConfig& config, Work work) {
  const LightSubimage& light = layout.light.front();
  const Subimage& subimage = source.subimages()[light.index];
  const LightReader reader(light.channels, config, light.space);
  Band band;
  LightRow row(static_cast<std::size_t>(subimage.data.width()));
  each_band(subimage, false, [&](int first, int rows) {
    source.read(light.index, first, rows, band);
    for (int y = 0; y < rows; ++y) {
      reader.read(band, y, row);
      work(std::as_const(row));
    }
  });
}

}  // namespace scotopic

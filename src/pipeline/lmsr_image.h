// An image's light as its receptors see it: files with channels L, M, S, R.
#pragma once

#include "pipeline/apply_image.h"

namespace scotopic {

/// What rods are where only colour is known.
struct RodChoice {
  RodEstimate estimate = RodEstimate::linear;
  double sp_ratio = sp_ratio_d65;
};

/// Turns a layout of RGB outputs (plan_layout) into one of L, M, S, R in its place; OpenEXR only,
/// Error(usage) otherwise. Other channels and pictures stay.
void make_lmsr_layout(ImageLayout& layout, const std::string& output);

/// Writes signals in luminance units per unit of the image: from receptors where the source has them, else
/// cones from XYZ and rods by `rods`. Same bytes for any number of threads. Half: values beyond its range
/// become its largest; night light below 6e-8 units is lost. Returns the pixels of the source that have a
/// component that is not finite; so are their signals.
NonFinitePixels write_lmsr(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                           const RodChoice& rods, OutputFile& file, const Progress& progress = nullptr);

}  // namespace scotopic

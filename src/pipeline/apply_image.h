// Stages on a whole file, band by band: what is measured of it, and what is written.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "pipeline/evaluator.h"
#include "pipeline/layout/layout.h"
#include "pipeline/rows/frame_light.h"
#include "pipeline/rows/non_finite.h"
#include "pipeline/rows/stages.h"
#include "pipeline/rows/threads.h"
#include "scene/scene_statistics.h"
#include "stages/acuity/filter.h"

namespace scotopic {

/// Called after each band with rows done and rows in all.
using Progress = std::function<void(std::int64_t done, std::int64_t total)>;

/// One after the other, each looking at what the one before has made of the whole picture.
using SpatialFilters = std::vector<const SpatialFilter*>;

/// What happens to light between reading and writing, in this order. What it points to must outlive it.
struct ImageStages {
  NonFinite non_finite = NonFinite::keep;
  const FrameLights* frames = nullptr;   ///< light as frame stages have left it; null: as the file has it
  std::optional<LightMatrices> light;    ///< on what the pixel stages get
  const Evaluator* evaluator = nullptr;  ///< pixel stages; null: nothing is called for
  SpatialFilters filters;                ///< on each picture by itself
  std::vector<const RowStage*> after;
  Moment moment;
  std::atomic<std::uint64_t>* clipped = nullptr;  ///< counts pixels that the output's type cannot hold
  std::atomic<std::uint64_t>* behind_alpha =
      nullptr;  ///< counts pixels whose light a straight alpha of 0 hides
};

/// What a pass over the light finds, smaller resolutions aside.
struct MeasuredLight {
  SceneStatistics whole;
  SceneStatistics region;      ///< of the pixels inside it
  NonFinitePixels non_finite;  ///< of the whole, in the file's coordinates
};

/// What to measure; at least one.
struct MeterRequest {
  bool whole = true;
  std::optional<Window> region;
};

/// One pass over the light of all pictures (full resolution only), or over a region of each, or both at once.
/// From `frames` where there are any: then the file is not read.
MeasuredLight measure_light(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                            const AppearanceParameters& parameters, const MeterRequest& request,
                            const FrameLights* frames = nullptr);

/// The same of all pixels, or of those of a region.
SceneStatistics measure_image(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                              const AppearanceParameters& parameters,
                              const std::optional<Window>& region = std::nullopt);

/// One pass over the light of all pictures (full resolution only): the values above 0 that the last of the
/// stages' filters leaves in R, in image units. What is added up are integers, so that threads make no
/// difference.
LuminanceHistogram measure_base(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                                const ImageStages& stages);

/// All pictures through the stages into a sink, which is finished then; see apply_image().
NonFinitePixels write_subimages(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                                const ImageStages& stages, PixelSink& sink, const Progress& progress);

/// Writes the whole output. Where no stage is called for and nothing else changes values either, the file's
/// own bytes go through. Same bytes for any number of threads. Returns the pixels of the file that are not
/// finite; with NonFinite::error such a file is refused, and nothing written.
NonFinitePixels apply_image(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                            const ImageStages& stages, OutputFile& file, const Progress& progress = nullptr);

}  // namespace scotopic

// What a display is sent: the last stages of an image, worked out of its scene. docs/display.md.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/display_batch.h"
#include "pipeline/apply_image.h"
#include "pipeline/notes.h"
#include "pipeline/settings.h"

namespace scotopic {

/// The scene's numbers aside.
NightDisplayParameters night_parameters(const StageValues& values);

/// Error(usage) for options of the display stage where the layout has none.
void refuse_idle_options(const DisplayChoice& choice, const ImageLayout& layout);

/// Error(config) for a view that the config does not have; a note where the view applies looks of its own.
void check_view(const ImageRequest& request, const ColourConfig& config, const Notes& notes);

/// What the tone map does; luminances in cd/m2 of the scene, sigma in pixels.
struct ToneReport {
  double low = 0, high = 0, compression = 0, sigma = 0;
};
/// The tone map of an image, and what is to be said of it.
struct ToneStage {
  std::unique_ptr<SpatialFilter> filter;  ///< nullptr: none
  std::vector<Attribute> stamps;
  std::optional<ToneReport> report;
};

/// Measures the range of the base layer where it is not told: one pass over the image through `stages`. Takes
/// the exposure over from the layout.
ToneStage tone_stage(const DisplayChoice& choice, const AppearanceParameters& scene, PixelSource& source,
                     ImageLayout& layout, const ColourConfig& config, const ImageStages& stages,
                     const Notes& notes);

/// What the display stage does; the peak in cd/m2, the dimming in stops.
struct NightReport {
  std::string space;
  double peak = 0, stops = 0, scale = 0;
  bool bends = false;  ///< bright light over a shoulder
};
/// The display stage of an image, and what is to be said of it.
struct NightStage {
  std::unique_ptr<const RowStage> rows;  ///< null: the stage does not run
  std::vector<Attribute> stamps;
  std::optional<NightReport> report;
};

/// For a layout that asks for it; takes the exposure over from the layout.
NightStage night_stage(const StageValues& values, const AppearanceParameters& scene, Precision precision,
                       const std::string& file, ImageLayout& layout, const Notes& notes);

}  // namespace scotopic

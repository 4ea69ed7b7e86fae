// The options of the last stage: what a display is sent. docs/display.md.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "cli/console.h"
#include "batch/display_batch.h"
#include "stages/display/local/display.h"
#include "pipeline/apply_image.h"

namespace scotopic {

/// As typed.
struct DisplayOptions {
  std::string display;
  std::string tone;
  std::string visibility = "hdrvdp2";
  std::string viewing = "18";
  std::string strength = "1";
  std::string contrast = "5";
  std::string peak = "100";
  std::string night_range = "0.35";
  std::string night_exponent = "1";
  std::string range = "auto";
};

/// As understood.
struct DisplayChoice {
  bool tone = false;                  ///< the local tone map runs
  NightDisplayParameters night;       ///< of the display stage: what options alone tell
  DisplayParameters parameters;       ///< what options alone tell
  std::optional<DisplayRange> range;  ///< nullopt: measured
  std::string of_night;               ///< an option given that only the display stage knows; empty: none
};

void add_display_options(CLI::App& verb, DisplayOptions& options);

/// Error(usage) for a value that is not understood, and for options of a stage that does not run. Sets the view of
/// `request`, and whether the display stage runs.
DisplayChoice understand(const DisplayOptions& options, ImageRequest& request);

/// Error(usage) for options of the display stage where the layout has none.
void refuse_idle_options(const DisplayChoice& choice, const ImageLayout& layout);

/// Error(config) for a view that the config does not have; a note where the view applies looks of its own.
void check_view(const ImageRequest& request, const ColourConfig& config, const Console& console);

/// The tone map of an image, and what is to be said of it.
struct DisplayStage {
  std::unique_ptr<SpatialFilter> filter;  ///< nullptr: none
  std::vector<Attribute> stamps;
  nlohmann::ordered_json report;
};

/// Measures the range of the base layer where it is not told: one pass over the image through the operator
/// and `before`. Takes the exposure over from the layout.
DisplayStage display_stage(const DisplayChoice& choice, const AppearanceParameters& scene,
                           PixelSource& source, ImageLayout& layout, const ColourConfig& config,
                           const RowOperator& apply, const SpatialFilters& before, const Console& console);

/// The display stage of an image whose layout asks for it; takes the exposure over from the layout.
struct ShownNight {
  std::shared_ptr<const DisplayBatch> batch;  ///< null: the stage does not run
  std::vector<Attribute> stamps;
  nlohmann::ordered_json report;
};
ShownNight night_stage(const DisplayChoice& choice, const AppearanceParameters& scene, Precision precision,
                       const std::string& file, ImageLayout& layout, const Console& console);

/// Of stamps that tell how light was seen, those that still hold for what a display or another device is
/// sent.
void correct_stamps(std::vector<Attribute>& stamps, const DisplayChoice& choice, const ImageLayout& layout);

}  // namespace scotopic

// The options of the last stage: what a display is sent. docs/display.md.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "cli/console.h"
#include "stages/display/local/display.h"
#include "pipeline/apply_image.h"

namespace scotopic {

/// As typed.
struct DisplayOptions {
  std::string view;
  std::string tone;
  std::string contrast = "5";
  std::string peak = "100";
  std::string night_range = "0.35";
  std::string night_exponent = "1";
  std::string range = "auto";
};

/// As understood.
struct DisplayChoice {
  bool tone = false;                  ///< the tone map runs
  DisplayParameters parameters;       ///< what options alone tell
  std::optional<DisplayRange> range;  ///< nullopt: measured
};

void add_display_options(CLI::App& verb, DisplayOptions& options);

/// Error(usage) for a value that is not understood, and for options of a tone map that does not run. Sets the
/// view of `request`.
DisplayChoice understand(const DisplayOptions& options, ImageRequest& request);

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

/// Of stamps that tell how light was seen, those that still hold for what a display or another device is
/// sent.
void correct_stamps(std::vector<Attribute>& stamps, const DisplayChoice& choice, const ImageLayout& layout);

}  // namespace scotopic

// The options of the last stage: what a display is sent. docs/display.md.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct DisplayOptions {
  std::string display;
  std::string dither = "ordered";
  std::string tone;
  std::string contrast = "5";
  std::string night_range = "0.35";
  std::string night_exponent = "1";
  std::string range = "auto";
};

void add_display_options(CLI::App& verb, DisplayOptions& options);

/// Error(usage) for a value that is not understood, and for options of a stage that does not run. Sets the
/// view of `request`, and whether the display stage runs.
DisplayChoice parse(const DisplayOptions& options, const StageValues& stages, ImageRequest& request);

}  // namespace scotopic

// Output for a device that an ICC profile describes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/apply_image.h"

namespace scotopic {

/// As typed.
struct IccOptions {
  std::string profile;
  std::string intent;
  std::string jpeg_quality = "95";
};

/// --icc, --intent, --quality.
void add_icc_options(CLI::App& verb, IccOptions& options);

/// Reads the profile into `request`. Error(usage) for a value that is not understood or that other options
/// exclude; Error(config) for a profile that is none.
void parse(const IccOptions& options, ImageRequest& request);

}  // namespace scotopic

// Options about files: colour config and spaces, layer, pixel type, limits. The same words in every verb.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct ImageOptions {
  std::string config;
  std::string colourspace;
  std::string output_colourspace;
  std::string layer;
  std::string type;
  std::string exposure = "0";
  Limits limits;
};

/// Of the input: --config, --colorspace, --layer, --max-...
void add_input_options(CLI::App& verb, ImageOptions& options);
/// Of configs and LUTs alone: --max-config-size, --max-lut-size. Part of add_input_options().
void add_config_limits(CLI::App& verb, Limits& limits);
/// Of the output: --output-colorspace, -d, --exposure.
void add_output_options(CLI::App& verb, ImageOptions& options);

/// Error(usage) for a value that is not understood.
ImageRequest understand(const ImageOptions& options);

}  // namespace scotopic

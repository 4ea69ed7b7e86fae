// Options about files: colour config and spaces, layer, pixel type, limits. The same words in every verb.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct ImageOptions {
  std::string config;
  std::string working_primaries;
  std::string colourspace;
  std::string output_colourspace;
  std::string layer;
  std::string layers;
  std::string type;
  std::string exposure = "0";
  Limits limits;
};

/// Of the input: --config, --working-primaries, --colorspace, --layer, --max-...
void add_input_options(CLI::App& verb, ImageOptions& options);
/// Behind those, of verbs that make something of several layers.
void add_layers_option(CLI::App& verb, ImageOptions& options, const char* text);
/// Of configs and LUTs alone: --max-config-size, --max-lut-size. Part of add_input_options().
void add_config_limits(CLI::App& verb, Limits& limits);
/// Of the output: --output-colorspace, -d, --exposure.
void add_output_options(CLI::App& verb, ImageOptions& options);

/// The colour config that --config, or $OCIO, names, its scene_linear as --working-primaries says.
ColourConfig config_in_force(const ImageOptions& options);
/// That of a file.
ColourConfig config_at(const std::string& file, const ImageOptions& options);

/// CIE XYZ (D65) from RGB of --working-primaries: a known gamut, or a file of eight numbers, x y of red,
/// green, blue and white; nullopt where it is not given.
std::optional<Matrix3<double>> working_primaries(const std::string& text);
/// That option.
void add_working_primaries(CLI::App& verb, std::string& value);

/// Error(usage) for a value that is not understood.
ImageRequest parse(const ImageOptions& options);

}  // namespace scotopic

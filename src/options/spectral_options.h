// Options about spectra: how bands are weighed, and what lights a reflectance. The same words in every verb.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct BandOptions {
  std::string bands = "bin";
  std::string radiance;
  std::string receptors;
};

void add_band_options(CLI::App& verb, BandOptions& options);

/// Error(usage) for text that is none of the three, Error(input) for a file that holds no spectrum.
IlluminantChoice parse_illuminant(const std::string& text);

/// The illuminant's spectrum is used where the file turns out to hold reflectance. Error(usage) for a value
/// that is not understood.
SpectralOptions parse(const BandOptions& options, const IlluminantChoice& illuminant,
                      const std::string& layer);

}  // namespace scotopic

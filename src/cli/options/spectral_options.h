// Options about spectra: how bands are weighed, and what lights a reflectance. The same words in every verb.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "cli/console.h"
#include "cli/options/image_options.h"
#include "io/spectral/spectral_source.h"

namespace scotopic {

/// As typed.
struct BandOptions {
  std::string bands = "bin";
  std::string radiance;
  std::string receptors;
};

void add_band_options(CLI::App& verb, BandOptions& options);

/// A light by its name, its S/P ratio alone, or a file with its spectrum.
struct IlluminantChoice {
  std::string name;
  double sp_ratio = sp_ratio_d65;
  std::optional<Spectrum> spectrum;
};

/// Error(usage) for text that is none of the three, Error(input) for a file that holds no spectrum.
IlluminantChoice understand_illuminant(const std::string& text);

/// The illuminant's spectrum is used where the file turns out to hold reflectance. Error(usage) for a value
/// that is not understood.
SpectralOptions understand(const BandOptions& options, const IlluminantChoice& illuminant,
                           const std::string& layer);

/// Opens a spectral image, or a pattern of one file a wavelength, as such, and any other image as
/// open_source() does. With -v says what was assumed.
std::unique_ptr<PixelSource> open_input(const std::string& input, const SpectralOptions& options,
                                        const Limits& limits, const Console& console);

/// What a spectral source has to say of itself, for --json; null for any other.
nlohmann::ordered_json spectral_report(const PixelSource& source);

}  // namespace scotopic

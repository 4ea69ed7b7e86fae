// Spectral images as a source of receptor signals and XYZ.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/pixel_source.h"
#include "io/spectral/spectral_channels.h"
#include "receptors/spectral_integrator.h"

namespace scotopic {

/// What a file may leave open. Defaults are what is assumed, and said.
struct SpectralOptions {
  std::string layer;
  BandSampling sampling = BandSampling::bin;
  Accumulation accumulation = Accumulation::dual;
  /// Whether bands also become XYZ; without, Band::signals[4] to [6] stay empty.
  bool xyz = true;
  /// Overrules the file's attribute emissiveUnits.
  std::optional<BandUnit> band_unit;
  /// For reflectance: relative spectral power, and what to call it.
  std::optional<Spectrum> illuminant;
  std::string illuminant_name = "d65";
  /// Channels that already are integrals of radiance times l, m, s and V' (peak 1), W/(m2 sr); empty: none
  /// are.
  std::vector<std::string> receptor_channels;
};

/// Light weighed with a receptor outside the bands' range: its share, equal-energy light or the illuminant.
struct SpectralReport {
  SpectralKind kind = SpectralKind::emissive;
  std::size_t bands = 0;
  double first_nm = 0.0;
  double last_nm = 0.0;
  std::array<double, signal_count> outside{};
  /// What was assumed or ignored, one sentence each.
  std::vector<std::string> notes;
};

/// A spectral OpenEXR file: one subimage of ColourChannels::Kind::computed; bands and the preview R, G, B do
/// not appear among its channels, all others do. Signals are absolute (white_luminance 1 cd/m2) for radiance,
/// per cd/m2 of a perfect white for reflectance.
class SpectralSource : public PixelSource {
 public:
  /// What was found, assumed and lost.
  const SpectralReport& report() const noexcept { return report_; }

 protected:
  using PixelSource::PixelSource;
  SpectralReport report_;
};

/// nullptr if the file is a well-formed image without spectral bands. `file` may be a pattern with one %d (or
/// %04d) for the wavelength in nm: then it is the images of one channel each that exist with such names.
/// Throws Error(ExitCode::input or limit).
std::unique_ptr<SpectralSource> open_spectral_source(const std::string& file, const SpectralOptions& options,
                                                     const Limits& limits);

/// Whether a name has the %d of a sequence of wavelengths.
bool is_wavelength_pattern(const std::string& file);

/// Files that a pattern names, with their wavelengths, ascending. Throws Error(ExitCode::input) for none.
struct WavelengthFile {
  std::string file;
  double nm;
};
/// Throws Error(ExitCode::input) for none.
std::vector<WavelengthFile> files_of_pattern(const std::string& pattern);

}  // namespace scotopic

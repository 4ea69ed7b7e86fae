// An image that is open, its pixels not looked at.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "io/pixel_source.h"
#include "pipeline/layout/layout.h"
#include "pipeline/notes.h"
#include "pipeline/scene/scene_numbers.h"
#include "pipeline/settings.h"

namespace scotopic {

/// Opens a spectral image, or a pattern of one file a wavelength, as such, and any other image as
/// open_source() does.
std::unique_ptr<PixelSource> open_input(const std::string& input, const SpectralOptions& options,
                                        const Limits& limits, const Notes& notes);

/// What a spectral source has to say of itself; nullopt for any other.
std::optional<SpectralReport> spectral_report_of(const PixelSource& source);

/// Names of spectral signals in reports, in the order of all_signals.
inline constexpr std::array<const char*, signal_count> signal_names = {"L", "M", "S", "rods", "X", "Y", "Z"};

struct OpenImage {
  std::unique_ptr<PixelSource> source;
  ImageLayout layout;
  KnownNumbers known;

  /// Whether pixels of any subimage bring signals of receptors beside RGB.
  bool has_receptors() const;
};

/// `output` decides what the image will become.
OpenImage open_image(const ImageSettings& settings, const std::string& input, const std::string& output,
                     const Notes& notes);
/// To be read only: the layout says where the light is.
OpenImage open_to_read(const ImageSettings& settings, const std::string& input, const Notes& notes);

/// Whose colours the input's are taken to be, and why; and the output's.
std::string space_text(const ImageLayout& layout);
/// The first half of it.
std::string input_space_text(const ImageLayout& layout);
/// Says what was found, and what the output cannot hold.
void describe_layout(const PixelSource& source, const ColourConfig& config, const ImageLayout& layout,
                     const Notes& notes);

}  // namespace scotopic

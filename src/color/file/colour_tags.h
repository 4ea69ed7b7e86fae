// What files state of their colours, as it stands in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "color/primaries.h"

namespace scotopic {

/// Coding-independent code points (ITU-T H.273) of a PNG's cICP chunk.
struct CodePoints {
  int primaries = 2;
  int transfer = 2;
  int matrix = 0;
  bool full_range = true;
};

/// Exif's ColorSpace, with the interoperability index R03 that DCF 2.0 has for Adobe RGB. other: none of
/// both (uncalibrated, or a maker's own).
enum class ExifColour { none, srgb, adobe_rgb, other };

/// All that a file's header or chunks state of its colours.
struct ColourTags {
  std::string interop_id;       ///< OpenEXR's colorInteropID
  bool aces_container = false;  ///< acesImageContainerFlag is 1: SMPTE ST 2065-4
  std::optional<Primaries>
      primaries;  ///< chromaticities; cHRM; PrimaryChromaticities and WhitePoint; PRIMARIES
  std::optional<Xy> adopted_neutral;  ///< adoptedNeutral: what counts as white
  std::shared_ptr<const std::vector<std::byte>> icc;
  std::optional<CodePoints> code_points;
  std::optional<double> gamma;  ///< that decodes: 1/gAMA; of Radiance's GAMMA the one above 1
  bool radiance = false;        ///< of a Radiance picture, where they have names of their own
  bool srgb = false;            ///< PNG's chunk sRGB
  ExifColour exif = ExifColour::none;
  std::optional<double> exif_gamma;  ///< Exif's Gamma, that decodes
  /// TIFF's TransferFunction: light of each code, 0 to 65535; one table, or three of the same size.
  std::shared_ptr<const std::vector<std::uint16_t>> transfer_table;
};

}  // namespace scotopic

// What a file is to state of the colours that are written into it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "color/colour_config.h"

namespace scotopic {

struct WrittenTags {
  std::optional<Primaries> primaries;  ///< of linear light
  std::optional<Xy> adopted_neutral;   ///< where its white is not that of (1, 1, 1)
  bool srgb = false;                   ///< sRGB's primaries and curve
  bool linear = false;                 ///< light as it is
  /// For formats that embed one: of the device, the file's own, or made for primaries and curve; absent for
  /// sRGB and where nothing is known but a name.
  std::shared_ptr<const std::vector<std::byte>> icc;
};

WrittenTags written_tags(const ColourSpace& space, const ColourConfig& config);

/// Whether an OpenEXR file (`exr`), or one that embeds a profile, can say that its values are in this space.
/// OpenEXR says so of linear light, and of what the file's own colorInteropID named (`named`).
bool can_be_stated(const ColourSpace& space, bool exr, bool named);

/// An ICC profile (version 2) of encoded RGB; empty for a curve that such a one cannot hold (PQ, HLG).
std::vector<std::byte> make_profile(const TransferCurve& curve, const Matrix3<double>& xyz_from_rgb);

/// The same of tables from codes to light (0 to 65535): one for R, G and B, or three of the same size, one
/// behind the other. Empty for tables that fall or are all of one value.
std::vector<std::byte> make_table_profile(const std::vector<std::uint16_t>& tables,
                                          const Matrix3<double>& xyz_from_rgb);

/// Chromaticities of a matrix to CIE XYZ (D65): primaries of white D65.
Primaries primaries_of(const Matrix3<double>& xyz_from_rgb);

}  // namespace scotopic

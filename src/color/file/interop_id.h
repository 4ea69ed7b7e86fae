// Colour spaces by the Color Interop Forum's identifiers, as file headers state them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "color/primaries.h"
#include "color/transfer.h"

namespace scotopic {

/// Adobe RGB (1998): primaries of its encoding, white D65.
inline constexpr Primaries adobe_rgb_primaries{{0.640, 0.330}, {0.210, 0.710}, {0.150, 0.060}, white_d65};

/// The value of the decoding power of Adobe RGB (1998), 563/256.
inline constexpr double adobe_rgb_gamma = 563.0 / 256;

/// CIE XYZ (D65-adapted) from encoded values: first the curve, then the matrix.
struct RgbEncoding {
  TransferCurve curve;
  Matrix3<double> xyz_from_rgb = identity3<double>();
};

/// What a published identifier stands for: "Color Space Encodings for Texture Assets and CG Rendering" 1.1.0
/// (17) and "Color Space Encodings for Displays" (15) of the ASWF Color Interop Forum, 2026, and the name
/// that earlier papers had (srgbx_p3d65_display). nullopt for `data`, `unknown` and anything that is not
/// published.
std::optional<RgbEncoding> interop_encoding(std::string_view id);

/// The identifier without its leftmost namespace and one separator; empty where it has none.
std::string without_namespace(const std::string& id);

/// Whether its values are those of a camera's or a grading system's curve (ACEScc, LogC, S-Log3, ...):
/// "ACEScct", "ARRI LogC4", ... by what the name begins with; empty for others.
std::string camera_curve(std::string_view id);

}  // namespace scotopic

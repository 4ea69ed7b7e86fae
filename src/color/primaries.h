// RGB spaces from their chromaticities: the exact matrices that colour configs only hold rounded.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/matrix3.h"

namespace scotopic {

/// CIE 1931 chromaticity.
struct Xy {
  double x = 0;
  double y = 0;
};

/// Of an RGB space: its primaries and its white.
struct Primaries {
  Xy red, green, blue, white;
};

/// An RGB gamut by its short name, as options and file attributes know it.
struct NamedPrimaries {
  std::string_view name;   ///< rec709, rec2020, p3, ap1, ap0
  std::string_view label;  ///< as the ACES configs call the linear space
  Primaries primaries;
};

/// rec709 (ITU-R BT.709-6), rec2020 (ITU-R BT.2020-2), p3 (SMPTE EG 432-1, D65), ap1 (S-2014-004), ap0 (ST
/// 2065-1).
const std::vector<NamedPrimaries>& known_primaries();

/// The white of sRGB, BT.709 and all D65 spaces here: x = .3127, y = .3290.
inline constexpr Xy white_d65{0.3127, 0.3290};

/// ICC.1's profile connection space: XYZ (.9642, 1, .8249).
inline constexpr Xy icc_d50{0.9642 / (0.9642 + 1.0 + 0.8249), 1.0 / (0.9642 + 1.0 + 0.8249)};

/// Whether primaries span a space: finite, whites of a positive y, not on one line.
bool are_usable(const Primaries& primaries);

/// CIE XYZ with white Y = 1 from linear RGB, unadapted. The primaries must not lie on one line.
Matrix3<double> xyz_from_rgb(const Primaries& primaries);

/// Bradford transform (Lam 1985, as in ICC.1) that takes XYZ under white `from` to XYZ under white `to`.
Matrix3<double> bradford(Xy from, Xy to);
/// The same by CAT02 (CIE 159:2004), which camera makers' primaries go to ACES by.
Matrix3<double> cat02(Xy from, Xy to);

/// The same, adapted to D65 (x = .3127, y = .3290). RGB (1,1,1) gives Y = 1 to 1 ulp.
Matrix3<double> xyz_d65_from_rgb(const Primaries& primaries);

/// XYZ (D65) from the linear RGB of "rec709", "rec2020", "p3", "ap1" or "ap0"; nullopt for another name.
std::optional<Matrix3<double>> gamut_xyz_matrix(std::string_view name);

/// Chromaticities by which OpenEXR says that R, G, B are CIE X, Y, Z themselves: (1,0), (0,1), (0,0), white
/// (1/3,1/3).
const Primaries& cie_xyz_primaries();
/// Whether they are those, each to 1e-3.
bool are_cie_xyz(const Primaries& primaries);
/// Whether a space's RGB is CIE XYZ (D65): its matrix is the identity, to 5e-4.
bool is_cie_xyz(const Matrix3<double>& xyz_from_rgb);

/// The known set whose chromaticities all lie within 1e-3 of these; nullptr if there is none.
/// (Files hold them as float, often rounded to three or four digits.)
const NamedPrimaries* match_primaries(const Primaries& primaries);

/// Whether no element differs by more than 5e-4, as below.
bool same_matrix(const Matrix3<double>& a, const Matrix3<double>& b);

/// The known set whose xyz_d65_from_rgb differs from `m` by no more than 5e-4 in any element; nullptr if
/// none. (Blender's matrices use a white of four digits and so differ by 2.3e-4; the sets differ by more than
/// 1e-2.)
const NamedPrimaries* match_matrix(const Matrix3<double>& m);

}  // namespace scotopic

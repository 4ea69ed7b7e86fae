// Everything that decides the bytes of one LUT, and its text form inside the LUT's file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "stages/display/night_display.h"
#include "stages/lamp/lamp.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// What a LUT is of, and of what size.
struct LookSpec {
  AppearanceParameters parameters;
  std::string gamut = "working";  ///< as --gamut says it; the matrix is in the parameters
  std::string space;              ///< colour space that RGB goes in and comes out in
  bool encoded = false;           ///< one 3D LUT over encoded RGB 0..1
  std::size_t edge = 33;
  std::optional<Lamp> lamp = std::nullopt;                     ///< before the pixel stages; none: D65
  std::optional<NightDisplayParameters> night = std::nullopt;  ///< the display stage behind it
  std::string display;                                         ///< its primaries, as --gamut says such
};

/// "filament2021", "kirk2011", "safko2019", "cao2008".
std::string_view name_of(Model model);

/// One line, "key=value; key=value; ...", that read_spec() reads back exactly. Part of every LUT's file.
std::string spec_text(const LookSpec& spec);

/// The spec from the text of a file that contains such a line (after "parameters:"); nullopt if there is
/// none, or it is not whole, or a value is out of range.
std::optional<LookSpec> read_spec(std::string_view file_text);

}  // namespace scotopic

// The illuminants a user can name, by what matters to the rods: their S/P ratio.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "receptors/spectrum.h"

namespace scotopic {

/// Scotopic over photopic luminance of a kind of light; what it is.
struct NamedIlluminant {
  std::string_view name;
  double sp_ratio;
  std::string_view description;
};

/// All of them, in the order of help texts.
std::span<const NamedIlluminant> named_illuminants();

/// "d65, e, moon, ...": for help and error texts.
std::string illuminant_names();

/// S/P ratio from a name (lower case) or a positive finite decimal number; nullopt for anything else.
std::optional<double> parse_sp_ratio(std::string_view name_or_number);

/// Relative spectral power of a named illuminant: for reflectances, which need more than a ratio. Moonlight
/// is CIE daylight of 4490 K (S/P 2.03); the lamps are single products of their kind (S/P
/// .648, 1.330, 1.724).
std::optional<Spectrum> illuminant_spectrum(std::string_view name);

}  // namespace scotopic

// The illuminants a user can name, by what matters to the rods: their S/P ratio.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace scotopic {

/// Scotopic over photopic luminance of a kind of light; what it is.
struct NamedIlluminant {
  std::string_view name;
  double sp_ratio;
  std::string_view description;
};

std::span<const NamedIlluminant> named_illuminants();

/// "d65, e, moon, ...": for help and error texts.
std::string illuminant_names();

/// S/P ratio from a name (lower case) or a positive finite decimal number; nullopt for anything else.
std::optional<double> parse_sp_ratio(std::string_view name_or_number);

}  // namespace scotopic

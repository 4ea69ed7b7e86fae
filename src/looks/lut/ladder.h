// The looks that are shipped: adaptation luminances, and what artists and menus call them.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "looks/lut/look_spec.h"

namespace scotopic {

/// A rung.
struct LadderStep {
  double adaptation;       ///< cd/m2
  std::string_view scene;  ///< where an eye is adapted so
};

/// From light to dark. Scenes: order of magnitude of the luminance of grey surfaces there (illuminances of
/// dusk, moon and stars as in the IES Lighting Handbook; full moon .25 lx on reflectance .2 gives .016).
inline constexpr std::array<LadderStep, 9> ladder = {{{10, "lamplit room"},
                                                      {3, "shop windows"},
                                                      {1, "dusk"},
                                                      {0.3, "main road"},
                                                      {0.1, "street lighting"},
                                                      {0.03, "dim lane"},
                                                      {0.01, "full moon"},
                                                      {0.003, "half moon"},
                                                      {0.001, "starlight"}}};

/// "Mesopic 0.1 nit (street lighting)"; "Photopic 10 nit (lamplit room)" where nothing changes; for models
/// other than the default, " kirk2011" follows. No comma, colon, bar or slash, no leading sign, < 64 bytes:
/// OCIO lists looks with them.
std::string look_name(const AppearanceParameters& parameters);

/// Whether the look leaves every pixel as it is.
bool is_identity(const AppearanceParameters& parameters);

/// "filament2021_0.1", without extension.
std::string look_file_stem(const AppearanceParameters& parameters);

/// "0.1": shortest decimal.
std::string adaptation_text(double adaptation);

}  // namespace scotopic

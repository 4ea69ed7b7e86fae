// Adaptation luminances by name: the rungs that looks are shipped for, and what people call them.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace scotopic {

/// A rung.
struct NamedAdaptation {
  double adaptation;       ///< cd/m2
  std::string_view name;   ///< one word, as --adaptation takes it
  std::string_view scene;  ///< where an eye is adapted so, as looks and menus say it
};

/// From light to dark. Scenes: order of magnitude of the luminance of grey surfaces there (illuminances of
/// dusk, moon and stars as in the IES Lighting Handbook; full moon .25 lx on reflectance .2 gives .016).
inline constexpr std::array<NamedAdaptation, 9> named_adaptations = {{{10, "room", "lamplit room"},
                                                                      {3, "shop", "shop windows"},
                                                                      {1, "dusk", "dusk"},
                                                                      {0.3, "road", "main road"},
                                                                      {0.1, "street", "street lighting"},
                                                                      {0.03, "lane", "dim lane"},
                                                                      {0.01, "moon", "full moon"},
                                                                      {0.003, "half-moon", "half moon"},
                                                                      {0.001, "starlight", "starlight"}}};

/// The luminance of a rung by its name.
constexpr std::optional<double> named_adaptation(std::string_view name) noexcept {
  for (const NamedAdaptation& step : named_adaptations)
    if (step.name == name) return step.adaptation;
  return std::nullopt;
}

}  // namespace scotopic

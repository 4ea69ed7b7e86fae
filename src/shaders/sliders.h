// What a shader's user sets while it runs.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace scotopic::shaders {

enum class Slider : std::size_t {
  adaptation,
  white_luminance,
  strength,
  strength_shift,
  strength_luminance,
  strength_chroma,
  strength_display,
  viewing,
  peak
};
inline constexpr std::size_t slider_count = 9;

/// Of one of them, in every language. Labels are letters, digits, spaces and points: Resolve takes no others.
struct SliderText {
  std::string_view name;   ///< of the variable
  std::string_view label;  ///< what the host shows
  std::string_view unit;   ///< empty: a share
  double least, greatest;
  std::string_view sentence;
};

inline constexpr std::array<SliderText, slider_count> slider_texts = {{
    {"adaptation", "Adaptation", "cd/m2", 1e-6, 1e4, "luminance that the eye is adapted to"},
    {"white_luminance", "White luminance", "cd/m2", 0, 1e5, "what value 1 stands for; 0: adaptation/0.18"},
    {"strength", "Strength", "", 0, 1, "of all stages but display, a linear mix of input and result"},
    {"strength_shift", "Shift", "", 0, 1, "of the colour that rods add"},
    {"strength_luminance", "Luminance", "", 0, 1, "of the luminance policy"},
    {"strength_chroma", "Chroma", "", 0, 1, "of the loss of colour"},
    {"strength_display", "Display", "", 0, 1,
     "of how much darker the display shows what the eye sees less of"},
    {"viewing", "Viewing adaptation", "cd/m2", 1e-3, 1e4, "what eyes at the display are adapted to"},
    {"peak", "Display peak", "cd/m2", 1, 1e4, "luminance of the display at value 1 of the result"},
}};

constexpr const SliderText& text_of(Slider slider) noexcept {
  return slider_texts[static_cast<std::size_t>(slider)];
}

/// What sliders stand at when the shader is loaded.
using SliderValues = std::array<double, slider_count>;

}  // namespace scotopic::shaders

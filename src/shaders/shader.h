// The operator as the text of a shader: pixel stages and the display stage, exact, from the formulas that the
// program runs.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "stages/display/night_display.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// Languages, and the hosts that the text is laid out for.
enum class ShaderLanguage {
  dctl,   ///< DaVinci Resolve: a Transform DCTL with sliders
  blink,  ///< Nuke: a kernel for BlinkScript
  glsl,   ///< Flame's Matchbox: GLSL 1.20 with uniforms
  osl,    ///< renderers: a node of one colour in, one out
  hlsl,   ///< ReShade, and pixel shaders of Direct3D
};

struct ShaderLanguageName {
  std::string_view name;
  ShaderLanguage language;
};
inline constexpr std::array<ShaderLanguageName, 5> shader_languages = {{{"dctl", ShaderLanguage::dctl},
                                                                        {"blink", ShaderLanguage::blink},
                                                                        {"glsl", ShaderLanguage::glsl},
                                                                        {"osl", ShaderLanguage::osl},
                                                                        {"hlsl", ShaderLanguage::hlsl}}};

/// What a shader is of. Model, weight, policy, rods, S/P ratio and gamut are fixed in its text; adaptation,
/// white luminance and the strengths of stages that are not 0 are sliders, and stand at these values when it
/// is loaded.
struct ShaderSpec {
  AppearanceParameters parameters;
  bool white_from_adaptation = true;  ///< the slider stands at 0: middle grey is what the eye is adapted to
  std::optional<NightDisplayParameters> display =
      std::nullopt;          ///< the display stage behind it; its La and unit are the operator's
  std::string space;         ///< name of the linear RGB that goes in and comes out, for the header
  std::string gamut;         ///< likewise, of the projection's
  std::string display_name;  ///< likewise, of the display's primaries
  std::string version;       ///< of the program, likewise
};

/// The text. ASCII; the same bytes for the same spec, whatever the locale.
/// Error against the operator in double, in float arithmetic with library functions to 2 ulp, over 28 stops
/// and adaptation of 1e-5 to 100 cd/m2, at every strength: 2e-5 of the pixel's largest component, in or out
/// (measured: 3e-6, outside the gamut 6e-6); 5e-3 for colours of no light, whose luminance is what is left of
/// a cancellation (tests/shaders).
std::string shader_text(const ShaderSpec& spec, ShaderLanguage language);

}  // namespace scotopic

// HLSL: a pixel shader of Direct3D, and an effect of ReShade, which says of itself that it is there.
#include <fmt/format.h>

#include <cmath>

#include "shaders/print/header.h"
#include "shaders/print/languages.h"

namespace scotopic::shaders {
namespace {

constexpr Spelling hlsl_spelling = {"", "bool", "min", "max", "abs", "sqrt", "exp", "log", "pow"};

// ReShade's sliders are linear, adaptation is not.
bool logarithmic(Slider slider) { return slider == Slider::adaptation; }
double shown(Slider slider, double value) { return logarithmic(slider) ? std::log10(value) : value; }
std::string variable_of(Slider slider) {
  return (logarithmic(slider) ? "log10_" : "") + std::string(text_of(slider).name);
}

std::string reshade_sliders(const Statements& s, const Record& record) {
  std::string out;
  for (const Slider slider : s.used) {
    const SliderText& text = text_of(slider);
    out += fmt::format(
        "uniform float {} < ui_type = \"slider\"; ui_label = \"{}{}{}\"; ui_min = {}; ui_max = {}; > = {};\n",
        variable_of(slider), text.label, logarithmic(slider) ? ", log10" : "",
        text.unit.empty() ? "" : " " + std::string(text.unit),
        number_in(hlsl_spelling, shown(slider, text.least)),
        number_in(hlsl_spelling, shown(slider, text.greatest)),
        number_in(hlsl_spelling, shown(slider, record.defaults[static_cast<std::size_t>(slider)])));
  }
  return out;
}

std::string constant_buffer(const Statements& s) {
  std::string out = "cbuffer Scotopic : register(b0)\n{\n";
  for (const Slider slider : s.used) out += fmt::format("  float {};\n", variable_of(slider));
  return out + "};\nTexture2D<float4> front : register(t0);\n";
}

constexpr const char* reshade_technique = R"(texture scotopic_picture : COLOR;
// Decoded from sRGB here, encoded on writing.
sampler scotopic_front { Texture = scotopic_picture; SRGBTexture = true; };
void scotopic_triangle(in uint id : SV_VertexID, out float4 position : SV_Position, out float2 at : TEXCOORD)
{
  at = float2(id == 2 ? 2.0 : 0.0, id == 1 ? 2.0 : 0.0);
  position = float4(at * float2(2.0, -2.0) + float2(-1.0, 1.0), 0.0, 1.0);
}
float4 scotopic_pixel(float4 position : SV_Position, float2 at : TEXCOORD) : SV_Target
{
  float4 pixel = tex2D(scotopic_front, at);
  return float4(scotopic(pixel.rgb), pixel.a);
}
technique Scotopic
{
  pass { VertexShader = scotopic_triangle; PixelShader = scotopic_pixel; SRGBWriteEnable = true; }
}
)";

constexpr const char* main_function = R"(float4 main(float4 position : SV_Position) : SV_Target
{
  float4 pixel = front.Load(int3(int2(position.xy), 0));
  return float4(scotopic(pixel.rgb), pixel.a);
}
)";

}  // namespace

std::string hlsl_text(const ShaderSpec& spec, const Record& record) {
  const Statements s = statements_of(record, hlsl_spelling);
  std::string adaptation;
  for (const Slider slider : s.used)
    if (logarithmic(slider)) adaptation = "  float adaptation = exp(log10_adaptation * 2.3025851);\n";
  return header_of(spec, s, "HLSL, for ReShade and Direct3D") + "\n#ifdef __RESHADE__\n" +
         reshade_sliders(s, record) + "#else\n" + constant_buffer(s) +
         "#endif\n\nfloat3 scotopic(float3 rgb)\n{\n  float r = rgb.x;\n  float g = rgb.y;\n  float b = "
         "rgb.z;\n" +
         adaptation + "  // the same for every pixel\n" + text_of(s.of_sliders, "  ") +
         text_of(s.of_pixel, "  ") +
         fmt::format("  return float3({}, {}, {});\n}}\n\n", s.out[0], s.out[1], s.out[2]) +
         "#ifdef __RESHADE__\n" + reshade_technique + "#else\n" + main_function + "#endif\n";
}

}  // namespace scotopic::shaders

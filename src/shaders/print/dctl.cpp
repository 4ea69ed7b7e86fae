// DCTL, the C of DaVinci Resolve, as its README describes it (19): one function, as its compiler likes it
// best.
#include <fmt/format.h>

#include <cmath>

#include "shaders/print/header.h"
#include "shaders/print/languages.h"

namespace scotopic::shaders {
namespace {

constexpr Spelling dctl_spelling = {"f",      "bool",  "_fminf", "_fmaxf", "_fabs",
                                    "_sqrtf", "_expf", "_logf",  "_powf"};

std::string slider_of(Slider slider, double value) {
  const SliderText& text = text_of(slider);
  const std::string unit = text.unit.empty() ? "" : " cd per m2";
  // Resolve's sliders are linear, adaptation is not.
  if (slider == Slider::adaptation)
    return fmt::format(
        "DEFINE_UI_PARAMS(log10_{}, {} log10{}, DCTLUI_SLIDER_FLOAT, {:.9g}, {:g}, {:g}, 0.01)\n", text.name,
        text.label, unit, std::log10(value), std::log10(text.least), std::log10(text.greatest));
  const double step = text.unit.empty() ? 0.01 : 0.1;
  return fmt::format("DEFINE_UI_PARAMS({}, {}{}, DCTLUI_SLIDER_FLOAT, {:.9g}, {:g}, {:g}, {:g})\n", text.name,
                     text.label, unit, value, text.least, text.greatest, step);
}

}  // namespace

std::string dctl_text(const ShaderSpec& spec, const Record& record) {
  const Statements s = statements_of(record, dctl_spelling);
  std::string sliders, adaptation;
  for (const Slider slider : s.used) {
    sliders += slider_of(slider, record.defaults[static_cast<std::size_t>(slider)]);
    if (slider == Slider::adaptation)
      adaptation = "    float adaptation = _expf(log10_adaptation * 2.3025851f);\n";
  }
  return header_of(spec, s, "A Transform DCTL for DaVinci Resolve") + "\n" + sliders +
         "\n__DEVICE__ float3 transform(int p_Width, int p_Height, int p_X, int p_Y, float r, float g, float "
         "b)\n{\n" +
         adaptation + "    // the same for every pixel\n" + text_of(s.of_sliders, "    ") +
         text_of(s.of_pixel, "    ") +
         fmt::format("    return make_float3({}, {}, {});\n}}\n", s.out[0], s.out[1], s.out[2]);
}

}  // namespace scotopic::shaders

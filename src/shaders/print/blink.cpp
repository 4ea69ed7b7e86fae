// Blink, the C++ of Nuke's BlinkScript: what is the same for every pixel is worked out in init().
#include <fmt/format.h>

#include "shaders/print/header.h"
#include "shaders/print/languages.h"

namespace scotopic::shaders {
namespace {

constexpr Spelling blink_spelling = {"f", "bool", "min", "max", "fabs", "sqrt", "exp", "log", "pow"};

std::string members_of(const Statements& s) {
  std::string out = "param:\n";
  for (const Slider slider : s.used) out += fmt::format("  float {};\n", text_of(slider).name);
  out += "\nlocal:\n";
  for (const Statement& c : s.of_sliders) out += fmt::format("  {} {};\n", c.type, c.name);
  return out;
}

std::string define_of(const Statements& s, const Record& record) {
  std::string out = "  void define() {\n";
  for (const Slider slider : s.used) {
    const SliderText& text = text_of(slider);
    out += fmt::format("    defineParam({}, \"{}{}\", {});\n", text.name, text.label,
                       text.unit.empty() ? "" : ", " + std::string(text.unit),
                       number_in(blink_spelling, record.defaults[static_cast<std::size_t>(slider)]));
  }
  return out + "  }\n";
}

}  // namespace

std::string blink_text(const ShaderSpec& spec, const Record& record) {
  const Statements s = statements_of(record, blink_spelling);
  return header_of(spec, s, "A BlinkScript kernel for Nuke") +
         "\nkernel Scotopic : ImageComputationKernel<ePixelWise>\n{\n"
         "  Image<eRead, eAccessPoint, eEdgeClamped> src;\n  Image<eWrite> dst;\n\n" +
         members_of(s) + "\n" + define_of(s, record) + "\n  void init() {\n" +
         assignments_of(s.of_sliders, "    ") +
         "  }\n\n  void process() {\n    SampleType(src) pixel = src();\n    float r = pixel.x;\n    float g "
         "= pixel.y;\n"
         "    float b = pixel.z;\n" +
         text_of(s.of_pixel, "    ") +
         fmt::format("    dst() = float4({}, {}, {}, pixel.w);\n  }}\n}};\n", s.out[0], s.out[1], s.out[2]);
}

}  // namespace scotopic::shaders

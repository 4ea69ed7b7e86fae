// OSL: a shader node of one colour in, one out; for Blender's Script node, Arnold, RenderMan.
#include <fmt/format.h>

#include "shaders/print/header.h"
#include "shaders/print/languages.h"

namespace scotopic::shaders {
namespace {

// A yes or no is an int.
constexpr Spelling osl_spelling = {"", "int", "min", "max", "fabs", "sqrt", "exp", "log", "pow"};

std::string parameters_of(const Statements& s, const Record& record) {
  std::string out;
  for (const Slider slider : s.used) {
    const SliderText& text = text_of(slider);
    out +=
        fmt::format("  float {} = {} [[ string label = \"{}\", float min = {}, float max = {} ]],\n",
                    text.name, number_in(osl_spelling, record.defaults[static_cast<std::size_t>(slider)]),
                    text.label, number_in(osl_spelling, text.least), number_in(osl_spelling, text.greatest));
  }
  return out;
}

}  // namespace

std::string osl_text(const ShaderSpec& spec, const Record& record) {
  const Statements s = statements_of(record, osl_spelling);
  return header_of(spec, s, "An OSL shader for renderers") +
         "\nshader scotopic(\n  color Cin = color(0.0, 0.0, 0.0),\n" + parameters_of(s, record) +
         "  output color Cout = color(0.0, 0.0, 0.0))\n{\n  float r = Cin[0];\n  float g = Cin[1];\n  float "
         "b = Cin[2];\n"
         "  // the same for every pixel\n" +
         text_of(s.of_sliders, "  ") + text_of(s.of_pixel, "  ") +
         fmt::format("  Cout = color({}, {}, {});\n}}\n", s.out[0], s.out[1], s.out[2]);
}

}  // namespace scotopic::shaders

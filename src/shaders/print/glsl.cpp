// GLSL 1.20 laid out as a Matchbox shader of Flame: the input is `front`; sliders are uniforms. Its function
// is all another host needs.
#include <fmt/format.h>

#include "shaders/print/header.h"
#include "shaders/print/languages.h"

namespace scotopic::shaders {
namespace {

constexpr Spelling glsl_spelling = {"", "bool", "min", "max", "abs", "sqrt", "exp", "log", "pow"};

std::string uniforms_of(const Statements& statements, const Record& record) {
  std::string out;
  for (const Slider slider : statements.used)
    out += fmt::format("uniform float {} = {};\n", text_of(slider).name,
                       number_in(glsl_spelling, record.defaults[static_cast<std::size_t>(slider)]));
  return out;
}

}  // namespace

std::string glsl_text(const ShaderSpec& spec, const Record& record) {
  const Statements s = statements_of(record, glsl_spelling);
  return "#version 120\n" + header_of(spec, s, "GLSL, for Flame's Matchbox and others") +
         "\nuniform sampler2D front;\nuniform float adsk_result_w, adsk_result_h;\n" +
         uniforms_of(s, record) +
         "\nvec3 scotopic(vec3 rgb)\n{\n  float r = rgb.x;\n  float g = rgb.y;\n  float b = rgb.z;\n"
         "  // the same for every pixel\n" +
         text_of(s.of_sliders, "  ") + text_of(s.of_pixel, "  ") +
         fmt::format("  return vec3({}, {}, {});\n}}\n\n", s.out[0], s.out[1], s.out[2]) +
         "void main()\n{\n"
         "  vec4 pixel = texture2D(front, gl_FragCoord.xy / vec2(adsk_result_w, adsk_result_h));\n"
         "  gl_FragColor = vec4(scotopic(pixel.rgb), pixel.a);\n}\n";
}

}  // namespace scotopic::shaders

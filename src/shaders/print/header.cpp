#include "shaders/print/header.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "pipeline/scene/parameter_names.h"

namespace scotopic::shaders {
namespace {

/// A name from a config, for a comment: it may hold a line's end, or letters that hosts' compilers do not
/// read.
std::string plain(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c < ' ' || c > '~' || c == '\\'; }, '?');
  return name;
}

std::string stages_of(const ShaderSpec& spec) {
  const AppearanceParameters& p = spec.parameters;
  if (p.model == Model::safko2019) return "the kernel alone";
  std::string out;
  const auto add = [&](bool on, const char* name) {
    if (on) add_to_list(out, name);
  };
  add(p.strength.shift > 0, "shift");
  add(p.strength.luminance > 0 && p.luminance != LuminancePolicy::none, "luminance");
  add(p.strength.chroma > 0, "chroma");
  return out.empty() ? "none" : out;
}

std::string matrix_of(const Matrix3<double>& m) {
  std::string out;
  for (std::size_t i = 0; i < 3; ++i)
    out += fmt::format("//   {} = {:.7f} R {:+.7f} G {:+.7f} B\n", "XYZ"[i], m[i][0], m[i][1], m[i][2]);
  return out;
}

std::string operator_of(const ShaderSpec& spec) {
  const AppearanceParameters& p = spec.parameters;
  std::string out = fmt::format("// Model {}; stages: {}.", name_in(model_names, p.model), stages_of(spec));
  if (p.model == Model::safko2019)
    out += fmt::format(" Kernel units per cd/m2: {:.9g}.", p.safko_scale);
  else
    out += fmt::format(" Weight {}, luminance policy {}, gamut {}.", name_in(weight_names, p.weight),
                       name_in(luminance_names, p.luminance), spec.gamut);
  return out + fmt::format("\n// Rods from colour: {}, S/P ratio of the light {:.5g}.\n",
                           name_in(rod_names, p.rods), p.sp_ratio);
}

std::string display_of(const ShaderSpec& spec) {
  if (!spec.display)
    return "// Scene light in, scene light out, in the same unit: no display stage. What views it does so as "
           "before.\n";
  return fmt::format(
      "// Stage display behind it (visibility {}, primaries of {}): the result is light of the display, "
      "linear, 1 = its\n"
      "// peak, in the primaries above. Encode it for the display, with no tone map or view transform of "
      "scene light.\n",
      name_in(visibility_names, spec.display->rule), plain(spec.display_name));
}

std::string sliders_of(const Statements& statements) {
  std::string out = "// Sliders:\n";
  for (const Slider slider : statements.used) {
    const SliderText& text = text_of(slider);
    const std::string unit = text.unit.empty() ? "" : ", " + std::string(text.unit);
    out += fmt::format("//   {}{} ({:g} to {:g}): {}\n", text.name, unit, text.least, text.greatest,
                       text.sentence);
  }
  return out;
}

}  // namespace

std::string header_of(const ShaderSpec& spec, const Statements& statements, const std::string& what) {
  return fmt::format(
      "// What a dark-adapted eye sees of a scene. {}, made by scotopic {}: bake --shader.\n"
      "//\n"
      "// Takes and gives linear RGB of the space '{}'; to CIE XYZ, Y of white 1:\n{}{}{}{}"
      "// Formulas, no LUT: in float arithmetic within 2e-5 of the pixel's largest component, in or out, of "
      "what the program\n"
      "// computes in double; 5e-3 for colours of no light, whose luminance is what is left of a "
      "cancellation. The mesopic\n"
      "// weight (CIE 191 MES2) is a polynomial of degree 7 in log luminance, 2e-8 off. The rest are closed "
      "forms.\n"
      "// Of neighbours and time it knows nothing: no acuity, glare, contrast, noise, adaptation in time.\n",
      what, spec.version, plain(spec.space), matrix_of(spec.parameters.xyz_from_rgb), operator_of(spec),
      display_of(spec), sliders_of(statements));
}

std::string text_of(const std::vector<Statement>& statements, const std::string& indent) {
  std::string out;
  std::string_view section;
  for (const Statement& s : statements) {
    if (s.section != section && !s.section.empty())
      out += fmt::format("{}// {}\n", indent, section = s.section);
    out += fmt::format("{}{} {} = {};\n", indent, s.type, s.name, s.expression);
  }
  return out;
}

std::string assignments_of(const std::vector<Statement>& statements, const std::string& indent) {
  std::string out;
  for (const Statement& s : statements) out += fmt::format("{}{} = {};\n", indent, s.name, s.expression);
  return out;
}

}  // namespace scotopic::shaders

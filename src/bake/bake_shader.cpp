// bake --shader LANGUAGE: the operator as the text of a shader.
#include <fmt/format.h>

#include "bake/bake_options.h"
#include "options/image_options.h"
#include "options/values.h"
#include "pipeline/scene/parameter_names.h"
#include "shaders/shader.h"

namespace scotopic {
namespace {

ShaderLanguage language_of(const BakeOptions& o) {
  std::vector<std::pair<std::string, ShaderLanguage>> names;
  for (const ShaderLanguageName& known : shader_languages) names.emplace_back(known.name, known.language);
  return choice("--shader", o.shader, names);
}

/// Where the slider stands: at the middle of the ladder, if nothing else is said.
double adaptation_of(const BakeOptions& o) {
  if (o.adaptations.empty()) return AppearanceParameters().adaptation;
  const std::vector<double> given = adaptations_of(o);
  if (given.size() > 1)
    fail_value("--adaptation", o.adaptations.back(), "one luminance: in a shader it is a slider");
  return given.front();
}

VisibilityRule visibility_of(const BakeOptions& o) {
  if (o.visibility.empty()) return NightDisplayParameters().rule;
  return choice<VisibilityRule>("--visibility", o.visibility,
                                {visibility_names.begin(), visibility_names.end()});
}

ShaderSpec shader_spec(const BakeOptions& o, const ColourConfig& config) {
  const OperatorChoice choice = operator_choice(o.appearance);
  const LookSpec look = spec_for(choice, o, config, adaptation_of(o));
  if (look.encoded)
    throw Error(
        ExitCode::usage, "",
        fmt::format(
            "'{}' is not linear light, which a shader takes: give a linear --colorspace, and convert to it "
            "before the shader",
            look.space));
  ShaderSpec spec;
  spec.parameters = look.parameters;
  spec.white_from_adaptation = !choice.white_luminance;
  spec.space = look.space;
  spec.gamut = look.gamut;
  spec.version = SCOTOPIC_VERSION;
  spec.display_name = look.display;
  spec.display = look.night;
  if (spec.display) spec.display->rule = visibility_of(o);
  return spec;
}

ColourConfig config_of(const BakeOptions& o) {
  return ColourConfig::in_force(o.colour_config, o.limits, working_primaries(o.working_primaries));
}

void refuse_options_of_luts(const BakeOptions& o) {
  const BakeOptions usual;
  for (const auto& [option, given] :
       {std::pair("--size", o.size != usual.size), std::pair("--format", !o.format.empty()),
        std::pair("--max-error", !o.max_error.empty())})
    if (given) throw Error(ExitCode::usage, "", std::string(option) + " is of LUTs: a shader is exact");
}

}  // namespace

void check_shader_options(const BakeOptions& o) {
  refuse_options_of_luts(o);
  if (!o.appearance.adapt_white.empty())
    throw Error(
        ExitCode::usage, "",
        "--adapt-white is not in a shader: bake a LUT, or adapt the light by a matrix before the shader");
  (void)language_of(o);
  (void)visibility_of(o);
  (void)adaptation_of(o);
}

std::string shader_text_of(const BakeOptions& o) {
  check_shader_options(o);
  return shader_text(shader_spec(o, config_of(o)), language_of(o));
}

int bake_shader(const BakeOptions& o, const Console& console) {
  const ShaderSpec spec = shader_spec(o, config_of(o));
  const std::string text = shader_text(spec, language_of(o));
  OutputSet set;
  OutputFile& file = set.open(o.output);
  OutputSet::write(file, text);
  set.commit();
  console.note(
      fmt::format("{}: takes and gives linear '{}'{}", o.output, spec.space,
                  spec.display ? ", gives light of '" + spec.display_name + "', linear, 1 = its peak" : ""));
  console.result({{"shader",
                   {{"language", o.shader},
                    {"output", o.output},
                    {"space", spec.space},
                    {"display", spec.display ? spec.display_name : "none"}}}});
  return static_cast<int>(ExitCode::done);
}

}  // namespace scotopic

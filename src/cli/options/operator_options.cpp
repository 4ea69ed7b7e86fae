#include "cli/options/operator_options.h"

#include <algorithm>
#include <tuple>

#include "cli/options/values.h"
#include "cli/scene/adaptation_method.h"
#include "pipeline/scene/parameter_names.h"
#include "receptors/illuminant.h"

namespace scotopic {
namespace {

template <typename T>
using Names = std::vector<std::pair<std::string, T>>;

/// As choice() wants them.
template <typename T, std::size_t count>
Names<T> known(const NamesOf<T, count>& names) {
  return {names.begin(), names.end()};
}

double strength(const char* option, const std::string& text) {
  return number_in(option, text, 0, 1, "a strength from 0 (off) to 1 (the model)");
}

/// Effects that a comma-separated list leaves out have strength 0.
void choose_effects(const std::string& list, OperatorChoice& choice) {
  choice.plan_effects = list == "auto";
  if (list == "all" || choice.plan_effects) {
    choice.acuity = choice.glare = EffectWish::if_known;
    return;
  }
  Strengths& s = choice.parameters.strength;
  const Names<double*> effects = {{"shift", &s.shift}, {"luminance", &s.luminance}, {"chroma", &s.chroma}};
  double acuity = 0, glare = 0;
  Names<double*> known = effects;
  known.emplace_back("acuity", &acuity);
  known.emplace_back("glare", &glare);
  for (const char* whole : {"all", "none", "auto"}) known.emplace_back(whole, nullptr);
  std::vector<double*> chosen;
  for (std::size_t at = 0; list != "none" && at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    const std::string name = list.substr(at, comma - at);
    double* const effect = scotopic::choice("--effects", name, known);
    if (!effect) fail_value("--effects", list, "a list: all, none and auto stand alone");
    if (effect == &acuity) choice.acuity = EffectWish::yes;
    if (effect == &glare) choice.glare = EffectWish::yes;
    chosen.push_back(effect);
    at = comma + 1;
  }
  for (const auto& [name, value] : effects)
    if (std::find(chosen.begin(), chosen.end(), value) == chosen.end()) *value = 0;
}

const Names<std::string>& gamuts() {
  static const Names<std::string> names = {{"working", "working"}, {"rec709", "rec709"},
                                           {"rec2020", "rec2020"}, {"p3", "p3"},
                                           {"ap1", "ap1"},         {"none", "none"}};
  return names;
}

}  // namespace

void add_operator_options(CLI::App& verb, OperatorOptions& o) {
  const std::string group = "What is seen";
  const auto add = [&](const char* name, std::string& value, const std::string& text, const char* kind) {
    verb.add_option(name, value, text)->type_name(kind)->group(group);
  };
  add("--adaptation", o.adaptation, "Luminance the eye is adapted to, or its name (moon, street, ...: explain --adaptations), or metered: auto "
      "(log-average), auto:median, auto:p90, auto:X,Y,W,H",
      "CDM2|NAME|auto");
  add("--white-luminance", o.white_luminance,
      "What image value 1 stands for; overrides the file's whiteLuminance", "CDM2");
  add("--model", o.model, "filament2021 (default), kirk2011, safko2019", "NAME");
  add("--safko-scale", o.safko_scale, "T of safko2019: its kernel's units per cd/m2 (default 1)", "X");
  add("--effects", o.effects,
      "auto (default: what the scene calls for), all, none, or of glare,shift,luminance,chroma,acuity", "LIST");
  add("--strength", o.strength, "Of all effects, 0 to 1", "X");
  add("--strength-shift", o.strength_shift, "Of the rods' colour shift, 0 to 1", "X");
  add("--strength-luminance", o.strength_luminance, "Of the luminance policy, 0 to 1", "X");
  add("--strength-chroma", o.strength_chroma, "Of the loss of colour, 0 to 1", "X");
  add("--weight", o.weight, "local (default: a lamp stays photopic) or global", "NAME");
  add("--luminance", o.luminance, "mesopic (default), photopic, none", "NAME");
  add("--gamut", o.gamut, "Results stay in: working (default), rec709, rec2020, p3, ap1, none", "NAME");
  add("--illuminant", o.illuminant, "S/P ratio, spectrum (nm and power a line), or of: " + illuminant_names(),
      "NAME|S/P|FILE");
  add("--rods", o.rods, "Rods from colour: linear (default) or quadratic", "NAME");
}

OperatorChoice understand(const OperatorOptions& o) {
  OperatorChoice out;
  if (const std::optional<AdaptationMethod> metering = parse_adaptation_method(o.adaptation)) out.metering = *metering;
  else out.adaptation = adaptation_value(o.adaptation);
  if (!o.white_luminance.empty())
    out.white_luminance = luminance_value("--white-luminance", o.white_luminance);
  AppearanceParameters& p = out.parameters;
  p.model = choice("--model", o.model, known(model_names));
  if (!o.safko_scale.empty()) {
    if (p.model != Model::safko2019) fail_value("--safko-scale", o.safko_scale, "for --model " + o.model + ": safko2019 alone has it");
    p.safko_scale = number_in("--safko-scale", o.safko_scale, 1e-9, 1e9, "a number of kernel units per cd/m2, 1e-9 to 1e9");
  }
  p.strength.all = strength("--strength", o.strength);
  p.strength.shift = strength("--strength-shift", o.strength_shift);
  p.strength.luminance = strength("--strength-luminance", o.strength_luminance);
  p.strength.chroma = strength("--strength-chroma", o.strength_chroma);
  choose_effects(o.effects, out);
  p.weight = choice("--weight", o.weight, known(weight_names));
  p.luminance = choice("--luminance", o.luminance, known(luminance_names));
  out.gamut = choice("--gamut", o.gamut, gamuts());
  out.illuminant = understand_illuminant(o.illuminant);
  p.sp_ratio = out.illuminant.sp_ratio;
  p.rods = choice("--rods", o.rods, known(rod_names));
  return out;
}

std::string without_effect(const OperatorOptions& o, const AppearanceParameters& parameters) {
  if (parameters.model != Model::safko2019) return "";
  const OperatorOptions usual;
  std::string out;
  for (const auto& [name, value, its_usual] :
       {std::tuple("--strength", &o.strength, &usual.strength),
        std::tuple("--strength-shift", &o.strength_shift, &usual.strength_shift),
        std::tuple("--strength-luminance", &o.strength_luminance, &usual.strength_luminance),
        std::tuple("--strength-chroma", &o.strength_chroma, &usual.strength_chroma),
        std::tuple("--weight", &o.weight, &usual.weight), std::tuple("--luminance", &o.luminance, &usual.luminance),
        std::tuple("--gamut", &o.gamut, &usual.gamut)})
    if (*value != *its_usual) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

}  // namespace scotopic

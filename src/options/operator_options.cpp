#include "options/operator_options.h"

#include <algorithm>

#include "options/scene/adaptation_method.h"
#include "options/values.h"
#include "pipeline/scene/parameter_names.h"
#include "receptors/illuminant.h"
#include "receptors/spectral_weights.h"

namespace scotopic {
namespace {

template <typename T>
using Names = std::vector<std::pair<std::string, T>>;

/// As choice() wants them.
template <typename T, std::size_t count>
Names<T> known(const NamesOf<T, count>& names) {
  return {names.begin(), names.end()};
}

constexpr const char* whites = "lamp, a chromaticity x,y, or X,Y,Z (numbers above 0)";

/// XYZ of a light, any scale.
Vec3<double> white_of(const TabulatedCurve& light) {
  Vec3<double> out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = integrate(light, sensitivity(all_signals[index(Signal::x) + i]));
  return out;
}

std::optional<Vec3<double>> lamp_white(const std::string& text, const IlluminantChoice& illuminant) {
  if (text.empty()) return std::nullopt;
  if (text == "lamp") {
    if (!illuminant.spectrum)
      fail_value("--adapt-white", text, "known of an S/P ratio alone: name the illuminant, or give x,y");
    return white_of(illuminant.spectrum->curve());
  }
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::optional<double> number = parse_number(text.substr(at, comma - at));
    if (!number || !(*number >= 1e-6 && *number <= 1e9)) fail_value("--adapt-white", text, whites);
    numbers.push_back(*number);
    at = comma + 1;
  }
  if (numbers.size() == 3) return Vec3<double>{numbers[0], numbers[1], numbers[2]};
  if (numbers.size() != 2 || numbers[0] + numbers[1] >= 1) fail_value("--adapt-white", text, whites);
  return Vec3<double>{numbers[0] / numbers[1], 1, (1 - numbers[0] - numbers[1]) / numbers[1]};
}

const Names<std::string>& gamuts() {
  static const Names<std::string> names = {{"working", "working"}, {"rec709", "rec709"},
                                           {"rec2020", "rec2020"}, {"p3", "p3"},
                                           {"ap1", "ap1"},         {"none", "none"}};
  return names;
}

}  // namespace

void add_operator_options(CLI::App& verb, OperatorOptions& o, StagesShown shown) {
  const TextOptions add{verb, "What is seen"};
  add("--adaptation", o.adaptation,
      "Luminance the eye is adapted to, or its name (moon, street, ...: explain --adaptations), or metered: "
      "auto "
      "(log-average), auto:median, auto:p90, auto:X,Y,W,H",
      "CDM2|NAME|auto");
  add("--white-luminance", o.white_luminance,
      "What image value 1 stands for; overrides the file's whiteLuminance", "CDM2");
  add("--model", o.model, "filament2021 (default), kirk2011, safko2019, cao2008", "NAME");
  add("--safko-scale", o.safko_scale, "T of safko2019: its kernel's units per cd/m2 (default 1)", "X");
  add("--strength", o.strength, "Of all effects, 0 to 1: a mixture of the input and the result", "X");
  add_stage_options(verb, o.stages, shown);
  add("--weight", o.weight, "local (default: a lamp stays photopic) or global", "NAME");
  add("--luminance", o.luminance, "mesopic (default), photopic, none", "NAME");
  add("--gamut", o.gamut, "Results stay in: working (default), rec709, rec2020, p3, ap1, none", "NAME");
  add("--illuminant", o.illuminant, "S/P ratio, spectrum (nm and power a line), or of: " + illuminant_names(),
      "NAME|S/P|FILE");
  if (shown != StagesShown::fused)
    add("--adapt-white", o.adapt_white,
        "White that the eye is used to: lamp (that of --illuminant), x,y or X,Y,Z (default: none, D65)",
        "lamp|XY|XYZ");
  add("--rods", o.rods, "Rods from colour: linear (default) or quadratic", "NAME");
}

OperatorChoice parse(const OperatorOptions& o) {
  OperatorChoice out;
  if (const std::optional<AdaptationMethod> metering = parse_adaptation_method(o.adaptation))
    out.metering = *metering;
  else
    out.adaptation = adaptation_value(o.adaptation);
  if (!o.white_luminance.empty())
    out.white_luminance = luminance_value("--white-luminance", o.white_luminance);
  AppearanceParameters& p = out.parameters;
  p.model = choice("--model", o.model, known(model_names));
  if (!o.safko_scale.empty()) {
    if (p.model != Model::safko2019)
      fail_value("--safko-scale", o.safko_scale, "for --model " + o.model + ": safko2019 alone has it");
    p.safko_scale = number_in("--safko-scale", o.safko_scale, 1e-9, 1e9,
                              "a number of kernel units per cd/m2, 1e-9 to 1e9");
  }
  p.strength.all = number_in("--strength", o.strength, 0, 1, "a strength from 0 (off) to 1 (the model)");
  out.plan_effects = o.stages.effects == "auto";
  out.stages = parse(o.stages);
  out.stages.set_pixel_stages(p);
  p.weight = choice("--weight", o.weight, known(weight_names));
  p.luminance = choice("--luminance", o.luminance, known(luminance_names));
  out.gamut = choice("--gamut", o.gamut, gamuts());
  out.illuminant = parse_illuminant(o.illuminant);
  p.sp_ratio = out.illuminant.sp_ratio;
  out.lamp = lamp_white(o.adapt_white, out.illuminant);
  p.rods = choice("--rods", o.rods, known(rod_names));
  return out;
}

std::string without_effect(const OperatorOptions& o, const OperatorChoice& choice) {
  if (choice.parameters.model != Model::safko2019) return "";
  const OperatorOptions usual;
  std::string out;
  const auto add = [&](bool given, const char* name) {
    if (given) add_to_list(out, name);
  };
  add(o.strength != usual.strength, "--strength");
  for (const char* strength : {"strength-shift", "strength-luminance", "strength-chroma"})
    add(choice.stages.given(strength), (std::string("--") + strength).c_str());
  add(o.weight != usual.weight, "--weight");
  add(o.luminance != usual.luminance, "--luminance");
  add(o.gamut != usual.gamut, "--gamut");
  return out;
}

}  // namespace scotopic

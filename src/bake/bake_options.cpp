#include "bake/bake_options.h"

#include <string_view>

#include <fmt/format.h>

#include "options/values.h"
#include "looks/chain/read_back.h"
#include "looks/lut/shipped_looks.h"
#include "looks/lut/look_chain.h"

namespace scotopic {

std::size_t edge_of(const BakeOptions& o) {
  if (o.size.empty()) return 0;
  return choice<std::size_t>("--size", o.size,
                             {{"auto", 0}, {"17", 17}, {"33", 33}, {"65", 65}, {"129", 129}});
}

std::vector<double> adaptations_of(const BakeOptions& o) {
  std::vector<double> out;
  for (const std::string& text : o.adaptations) {
    if (text == "ladder")
      for (const NamedAdaptation& step : named_adaptations) out.push_back(step.adaptation);
    else if (text == "auto")
      fail_value("--adaptation", text, "luminances in cd/m2, or ladder: a LUT does not see the image");
    else
      out.push_back(adaptation_value(text));
  }
  if (out.empty()) throw Error(ExitCode::usage, "", "--adaptation is needed: luminances in cd/m2, or ladder");
  return out;
}

OperatorChoice operator_choice(const OperatorOptions& o) {
  const OperatorChoice out = parse(o);
  for (const StageEntry& entry : out.stages.table()) {
    const StageDescription& stage = *entry.description;
    if (stage.not_in_a_look.empty() || out.stages.wish(stage.name) != EffectWish::yes) continue;
    fail_value("--effects", o.stages.effects,
               fmt::format("for a look: {}: {}", stage.name, stage.not_in_a_look));
  }
  return out;
}

namespace {

/// "night" or "night:DISPLAY"; the display's space.
std::string display_of(const BakeOptions& o, const ColourConfig& config) {
  constexpr std::string_view night = "night";
  const std::string& text = o.display;
  if (text.substr(0, night.size()) != night || (text.size() > night.size() && text[night.size()] != ':'))
    fail_value("--display", text, "night, or night:DISPLAY");
  const std::string name = text.size() > night.size() + 1 ? text.substr(night.size() + 1) : "";
  return config.display_space(name.empty() ? config.ocio()->getDefaultDisplay() : name).name;
}

/// cd/m2; 1000 for displays of HDR.
double peak_of(const BakeOptions& o, const ColourConfig& config, const std::string& display) {
  if (!o.peak.empty()) return number_in("--peak", o.peak, 1, 1e5, "a luminance in cd/m2, 1 to 1e5");
  return std::string(config.ocio()->getColorSpace(display.c_str())->getEncoding()) == "hdr-video"
             ? 1000
             : display_white;
}

/// The display stage behind the operator, and what its result is encoded for.
void set_display(LookSpec& spec, const BakeOptions& o, const ColourConfig& config) {
  if (o.display.empty()) return;
  if (!spec.encoded && o.shader.empty())
    throw Error(ExitCode::usage, "",
                "--display is of cubes: give --colorspace a log or display encoding (a config's views are "
                "bake --config's)");
  spec.display = display_of(o, config);
  const auto encoding = config.encoding(config.space(spec.display));
  if (!encoding)
    throw Error(ExitCode::config, config.file(),
                "'" + spec.display + "' is no encoding of a display's R, G, B");
  NightDisplayParameters& night = spec.night.emplace();
  night.peak = peak_of(o, config, spec.display);
  night.xyz_from_display = encoding->xyz_from_rgb;
}

}  // namespace

LookSpec spec_for(OperatorChoice choice, const BakeOptions& o, const ColourConfig& config,
                  double adaptation) {
  set_primaries(choice, config);
  LookSpec spec;
  spec.parameters = parameters_of(choice, adaptation);
  spec.gamut = choice.gamut;
  spec.lamp = lamp_of(choice);
  if (spec.lamp && !changes_light(*spec.lamp, spec.parameters)) spec.lamp.reset();  // D65
  spec.edge = edge_of(o);
  spec.space = o.colourspace.empty() ? config.working_space() : config.resolve(o.colourspace);
  const std::optional<Matrix3<double>> linear = linear_space_matrix(config, spec.space);
  spec.encoded = !linear;
  if (linear) {
    // The operator works in the primaries that the look is given.
    spec.parameters.xyz_from_rgb = *linear;
    if (spec.gamut == "working") spec.parameters.xyz_from_gamut = *linear;
    if (spec.edge == 0) spec.edge = 33;
  }
  set_display(spec, o, config);
  return spec;
}

std::vector<LookSpec> specs_for_config(const BakeOptions& o, const ColourConfig& config) {
  std::vector<LookSpec> specs;
  OperatorChoice choice = operator_choice(o.appearance);
  for (const double adaptation : adaptations_of(o)) specs.push_back(spec_for(choice, o, config, adaptation));
  if (!o.beside.empty()) {
    OperatorOptions other = o.appearance;
    other.model = o.beside;
    choice = operator_choice(other);
    for (const double adaptation : adaptations_of(o)) {
      const LookSpec spec = spec_for(choice, o, config, adaptation);
      if (!is_identity(spec)) specs.push_back(spec);
    }
  }
  for (const LookSpec& spec : specs)
    if (spec.encoded)
      throw Error(ExitCode::usage, "", "looks of a config work on linear light: no --colorspace");
  return specs;
}

void check_error(const BakeOptions& o, const BakedLook& look) {
  if (o.max_error.empty()) return;
  const double limit = number_in("--max-error", o.max_error, 0, 1000, "a CIEDE2000 from 0 to 1000");
  if (look.largest_error() <= limit) return;
  throw Error(ExitCode::check_failed, "",
              fmt::format("{}: largest error {:.3g} exceeds {:.3g}; a larger --size helps", look.chain.name,
                          look.largest_error(), limit));
}

nlohmann::ordered_json json_of(const BakedLook& look) {
  nlohmann::ordered_json out = {
      {"look", look.chain.name},        {"adaptation", look.spec.parameters.adaptation},
      {"size", look.spec.edge},         {"mean", look.error.mean},
      {"p99", look.error.p99},          {"max", look.error.max},
      {"worstColour", look.error.worst}};
  if (look.cube) {
    const BakeError& trilinear = look.cube->rec709.by_reading[1];
    out["trilinear"] = {{"mean", trilinear.mean}, {"p99", trilinear.p99}, {"max", trilinear.max}};
  }
  return out;
}

std::string said(const BakedLook& look) {
  if (look.cube) {
    std::string text = fmt::format("{}, {} nodes a side", look.chain.name, look.spec.edge);
    for (const std::string& line : error_lines(*look.cube, look.spec)) text += "; " + line;
    return text;
  }
  const bool hdr = look.spec.night && look.spec.night->peak > display_white;
  return fmt::format("{}{}: {} to the operator: {}, at ({:.4g}, {:.4g}, {:.4g})", look.chain.name,
                     look.spec.night ? " for a display of " + look.spec.display : "",
                     hdr ? "delta E ITP" : "CIEDE2000", error_text(look.error), look.error.worst[0],
                     look.error.worst[1], look.error.worst[2]);
}

std::string command_of(const BakeOptions& o) {
  std::string text = "scotopic bake";
  for (const std::string& a : o.adaptations) text += " --adaptation " + a;
  if (!o.beside.empty()) text += " --beside " + o.beside;
  text += " --model " + o.appearance.model + " --size " + (o.size.empty() ? "33" : o.size) +
          (o.into.empty() ? " --config DIR" : " --into CONFIG");
  if (!o.appearance.adapt_white.empty()) text += " --adapt-white " + o.appearance.adapt_white;
  return o.luts.empty() ? text : text + " --luts LUTS";
}

void add_luts(OutputSet& files, const std::string& folder, const LookSet& set) {
  for (std::size_t i = 0; i < set.luts.size(); ++i) {
    const OutputFile& file = files.add(folder + "/" + set.luts[i].name, set.luts[i].text);
    const BakedLook& look = i < set.looks.size() ? set.looks[i] : set.night_luts[i - set.looks.size()];
    require_read_back(file.open_name(), file.path(), look.chain);
  }
}

}  // namespace scotopic

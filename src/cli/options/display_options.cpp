#include "cli/options/display_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cli/options/values.h"

namespace scotopic {
namespace {

DisplayRange parse_range(const std::string& text) {
  const char* const takes = "auto, or two luminances LOW,HIGH in cd/m2, the lower one first";
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) fail_value("--display-range", text, takes);
  const auto luminance = [&](const std::string& part) {
    return number_in("--display-range", part, 1e-12, 1e12, takes);
  };
  const DisplayRange out = {luminance(text.substr(0, comma)), luminance(text.substr(comma + 1))};
  if (!(out.low <= out.high)) fail_value("--display-range", text, takes);
  return out;
}

/// Options that only the tone map knows.
void refuse_idle_options(const DisplayOptions& o) {
  const DisplayOptions usual;
  const std::array<std::pair<const char*, bool>, 5> given = {
      {{"--contrast", o.contrast != usual.contrast},
       {"--peak", o.peak != usual.peak},
       {"--night-range", o.night_range != usual.night_range},
       {"--night-exponent", o.night_exponent != usual.night_exponent},
       {"--display-range", o.range != usual.range}}};
  for (const auto& [name, changed] : given)
    if (changed)
      throw Error(ExitCode::usage, "", std::string(name) + " is of the tone map: --display, or --tone local");
}

}  // namespace

void add_display_options(CLI::App& verb, DisplayOptions& o) {
  const auto add = [&](const char* name, std::string& value, const char* text, const char* kind) {
    verb.add_option(name, value, text)->type_name(kind)->group("Display");
  };
  add("--display", o.view, "Write what a display is sent under a view of the config", "[DISPLAY/]VIEW");
  add("--tone", o.tone,
      "local (default with --display): a bilateral tone map to the display's range; or none", "NAME");
  add("--contrast", o.contrast, "Span of large shapes on a display of 100 cd/m2 (default 5)", "X");
  add("--peak", o.peak, "Greatest luminance of the display (default 100)", "CDM2");
  add("--night-range", o.night_range, "Share of that left to what rods alone see (default 0.35; 1: all)",
      "X");
  add("--night-exponent", o.night_exponent,
      "How that share is reached: power of the rods' weight (default 1)", "X");
  add("--display-range", o.range,
      "Scene luminances of large shapes to be spanned: auto, or LOW,HIGH in cd/m2", "RANGE");
}

DisplayChoice understand(const DisplayOptions& o, ImageRequest& request) {
  DisplayChoice out;
  if (!o.view.empty()) request.view = o.view;
  if (request.view && request.output_colourspace)
    throw Error(ExitCode::usage, "", "either --display or --output-colorspace, not both");
  out.tone = request.view.has_value();
  if (!o.tone.empty()) out.tone = choice<bool>("--tone", o.tone, {{"local", true}, {"none", false}});
  DisplayParameters& p = out.parameters;
  p.contrast = number_in("--contrast", o.contrast, 1, 1e6, "a ratio of luminances, 1 to 1e6");
  p.peak = number_in("--peak", o.peak, 1, 1e5, "a luminance in cd/m2, 1 to 1e5");
  p.night_range = number_in("--night-range", o.night_range, 0, 1, "a share from 0 to 1");
  p.night_exponent = number_in("--night-exponent", o.night_exponent, 0.01, 100, "a power, 0.01 to 100");
  if (o.range != "auto") out.range = parse_range(o.range);
  if (!out.tone) refuse_idle_options(o);
  return out;
}

void check_view(const ImageRequest& request, const ColourConfig& config, const Console& console) {
  if (!request.view) return;
  const std::string looks = config.looks_of(*config.view(*request.view).view);
  if (!looks.empty())
    console.note(fmt::format("view '{}' applies a look of its own ({}), on top of this operator",
                             *request.view, looks));
}

DisplayStage display_stage(const DisplayChoice& choice, const AppearanceParameters& scene,
                           PixelSource& source, ImageLayout& layout, const ColourConfig& config,
                           const RowOperator& apply, const SpatialFilters& before, const Console& console) {
  DisplayStage out;
  if (!choice.tone) return out;
  const Window& data = source.pictures()[layout.light.front().index].data;
  DisplayParameters p = choice.parameters;
  p.adaptation = scene.adaptation;
  p.white_luminance = scene.white_luminance;
  p.weight = scene.weight;
  p.strength = scene.strength.all;
  p.exposure = layout.exposure;
  p.sigma = display_sigma(data.width(), data.height());
  p.xyz_from_rgb = scene.xyz_from_rgb;
  p.xyz_from_gamut = scene.xyz_from_gamut.value_or(scene.xyz_from_rgb);
  layout.exposure = 0;
  DisplayRange range{};
  if (choice.range) {
    range = *choice.range;
  } else {
    const BaseLayer base(p);
    SpatialFilters filters = before;
    filters.push_back(&base);
    range = range_of(measure_base(source, layout, config, apply, filters), p);
  }
  auto filter = std::make_unique<DisplayFilter>(p, range);
  console.note(
      fmt::format("{}: display: {:.3g} to {:.3g} cd/m2 of large shapes ({}) shown up to {:g} cd/m2, "
                  "their contrast to the power {:.2g}",
                  source.file(), range.low, range.high, choice.range ? "--display-range" : "measured", p.peak,
                  filter->compression()));
  out.stamps = {{"scotopic:displayLow", range.low},
                {"scotopic:displayHigh", range.high},
                {"scotopic:displayContrast", p.contrast},
                {"scotopic:displayPeak", p.peak},
                {"scotopic:displayNightRange", p.night_range},
                {"scotopic:displayNightExponent", p.night_exponent}};
  out.report = {
      {"low", range.low}, {"high", range.high}, {"compression", filter->compression()}, {"sigma", p.sigma}};
  out.filter = std::move(filter);
  return out;
}

void correct_stamps(std::vector<Attribute>& stamps, const DisplayChoice& choice, const ImageLayout& layout) {
  const bool device = layout.output_space.for_a_device();
  if (!device && !choice.tone) return;
  std::erase_if(stamps, [](const Attribute& a) { return a.name == "whiteLuminance"; });
  if (!device) stamps.push_back({"whiteLuminance", display_unit});
}

}  // namespace scotopic

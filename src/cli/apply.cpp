// scotopic apply: an image as the dark-adapted eye sees it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/acuity_options.h"
#include "cli/display_options.h"
#include "cli/icc_options.h"
#include "cli/image_options.h"
#include "cli/operator_options.h"
#include "cli/precision_options.h"
#include "cli/program.h"
#include "cli/scene_numbers.h"
#include "cli/scene_plan.h"
#include "cli/spectral_options.h"
#include "cli/values.h"
#include "image/acuity_rows.h"
#include "image/apply_image.h"
#include "image/non_finite.h"

namespace scotopic {
namespace {

struct ApplyOptions {
  std::string input;
  std::string output;
  OperatorOptions appearance;
  PrecisionOptions precision;
  BandOptions bands;
  AcuityOptions acuity;
  DisplayOptions display;
  IccOptions icc;
  std::string non_finite = "keep";
  ImageOptions image;
  CommonOptions common;
};

std::vector<Attribute> stamps_of(const AppearanceParameters& p, const OperatorChoice& choice,
                                 const ImageLayout& layout) {
  const auto share = [&](double strength) { return p.strength.all * strength; };
  const ColourChannels::Kind kind = layout.light.front().channels.kind;
  const bool own = kind == ColourChannels::Kind::lmsr || kind == ColourChannels::Kind::computed;
  std::vector<Attribute> stamps = {{"scotopic:version", std::string(SCOTOPIC_VERSION)},
                                   {"scotopic:model", model_name(p.model)},
                                   {"scotopic:adaptation", p.adaptation},
                                   {"scotopic:sceneWhiteLuminance", p.white_luminance},
                                   {"scotopic:strengthShift", share(p.strength.shift)},
                                   {"scotopic:strengthLuminance", share(p.strength.luminance)},
                                   {"scotopic:strengthChroma", share(p.strength.chroma)},
                                   {"scotopic:weight", weight_name(p.weight)},
                                   {"scotopic:luminance", luminance_name(p.luminance)},
                                   {"scotopic:gamut", choice.gamut},
                                   {"scotopic:rods", own ? "the file's own signals" : rods_name(p.rods)},
                                   {"scotopic:exposure", layout.exposure},
                                   {"scotopic:colorspace", layout.output_space.name},
                                   {"whiteLuminance", p.white_luminance / std::exp2(layout.exposure)}};
  if (!own) stamps.push_back({"scotopic:spRatio", p.sp_ratio});  // rods were estimated for that light
  if (p.model == Model::safko2019) stamps.push_back({"scotopic:safkoScale", p.safko_scale});
  return stamps;
}

nlohmann::ordered_json result_of(const ApplyOptions& options, const SceneNumbers& numbers,
                                 const ImageLayout& layout, const std::vector<Attribute>& stamps,
                                 const PixelSource& source) {
  nlohmann::ordered_json out;
  out["input"] = options.input;
  out["output"] = options.output;
  out["colorspace"] = layout.light.front().space.name;
  out["colorspaceSource"] = layout.light.front().space_reason;
  out["outputColorspace"] = layout.output_space.name;
  out["adaptationSource"] = numbers.adaptation_source;
  out["whiteLuminanceSource"] = numbers.white_luminance_source;
  for (const Attribute& stamp : stamps)
    std::visit([&](const auto& value) { out["applied"][stamp.name] = value; }, stamp.value);
  out["notes"] = layout.notes;
  if (const auto spectral = spectral_report(source); !spectral.is_null()) out["spectral"] = spectral;
  return out;
}

void describe_layout(const PixelSource& source, const ColourConfig& config, const ImageLayout& layout,
                     const Console& console) {
  const LightPicture& light = layout.light.front();
  const Window& w = source.pictures()[light.index].data;
  console.detail(fmt::format("{}: {} x {} pixels, {}, {} pictures, {} with light", source.file(), w.width(),
                             w.height(), source.format(), source.pictures().size(), layout.light.size()));
  console.detail(fmt::format("config {}, working space {}",
                             config.file().empty() ? "built in" : config.file(), config.working_space()));
  console.detail(fmt::format("colour space {} ({}), written as {}", light.space.name, light.space_reason,
                             layout.output_space.name));
  for (const std::string& note : layout.notes) console.note(source.file() + ": " + note);
  for (const Attribute& a : source.attributes(light.index))
    if (a.name == "scotopic:model")
      console.note(source.file() + ": has been through scotopic already; this is the second time");
}

/// The scene's statistics, where the adaptation depends on them.
std::optional<SceneStatistics> measure(PixelSource& source, const ImageLayout& layout,
                                       const ColourConfig& config, const OperatorChoice& choice,
                                       const KnownNumbers& known) {
  if (!needs_measurement(known, source.file())) return std::nullopt;
  return measure_image(source, layout, config, choice.parameters, choice.metering.region);
}

NonFinite non_finite_policy(const std::string& text) {
  return choice<NonFinite>("--nonfinite", text,
                           {{"keep", NonFinite::keep}, {"clean", NonFinite::clean}, {"error", NonFinite::error}});
}

/// Says once what was done with pixels that are no light; their number.
std::uint64_t report_non_finite(const NonFiniteWatch& watch, NonFinite policy, PixelSource& source,
                                const ImageLayout& layout, const ColourConfig& config, const Console& console) {
  if (watch.count() == 0) return 0;
  const NonFinitePixels pixels = find_non_finite(source, layout, config);
  console.note(fmt::format("{}: {}; {}", source.file(), describe(pixels),
                           policy == NonFinite::clean ? "cleaned" : "passed as they are (--nonfinite)"));
  return pixels.count;
}

/// Whether pixels bring signals of their own beside RGB.
bool has_receptors(const ImageLayout& layout) {
  using Kind = ColourChannels::Kind;
  return std::any_of(layout.light.begin(), layout.light.end(), [](const LightPicture& light) {
    return light.channels.kind == Kind::lmsr || light.channels.kind == Kind::computed;
  });
}

/// Of the filter and of the rest, before either is allocated.
void check_acuity_memory(const SpatialFilter& acuity, const PixelSource& source, const ImageLayout& layout,
                         const Limits& limits) {
  for (const LightPicture& light : layout.light) {
    const Picture& picture = source.pictures()[light.index];
    check_limit(source.file(), "bytes of memory planned", planned_bytes(picture) + acuity_bytes(acuity, picture),
                limits.memory, "--max-memory");
  }
}

int run_apply(const ApplyOptions& options) {
  const Console console(options.common);
  OperatorChoice choice = understand(options.appearance);
  const PrecisionChoice precision = understand(options.precision);
  const AcuityChoice acuity_choice = understand(options.acuity);
  const NonFinite non_finite = non_finite_policy(options.non_finite);
  ImageRequest request = understand(options.image);
  const DisplayChoice display_choice = understand(options.display, request);
  understand(options.icc, request);
  const SpectralOptions spectral = understand(options.bands, choice.illuminant, options.image.layer);
  (void)output_format(options.output);
  const ColourConfig config = ColourConfig::in_force(options.image.config, options.image.limits);
  check_spaces(request, config);
  check_view(request, config, console);
  set_primaries(choice, config);
  if (const std::string idle = without_effect(options.appearance, choice.parameters); !idle.empty())
    console.note("without effect under --model safko2019: " + idle);
  set_threads(options.common.threads);
  OutputFile file(options.output);
  const std::unique_ptr<PixelSource> source =
      open_input(options.input, spectral, options.image.limits, console);
  ImageLayout layout = plan_layout(*source, options.output, config, request);
  describe_layout(*source, config, layout, console);
  if (non_finite == NonFinite::error) refuse_non_finite(*source, layout, config);

  const KnownNumbers known = known_numbers(choice, *source, layout, console);
  const std::optional<SceneStatistics> statistics = measure(*source, layout, config, choice, known);
  const SceneNumbers numbers =
      settle(known, statistics ? metered(*statistics, choice.metering) : 0, source->file());
  console.note(source->file() + ": " + describe(numbers));
  AppearanceParameters& parameters = choice.parameters;
  parameters.adaptation = numbers.adaptation;
  parameters.white_luminance = numbers.white_luminance;
  const AngularResolution resolution = angular_resolution(acuity_choice, *source, layout);
  const ScenePlan plan =
      plan_of(choice, plan_request(choice, acuity_choice, resolution), statistics ? &*statistics : nullptr);
  console.note(source->file() + ": " + plan_line(plan));
  parameters = plan.parameters;
  const std::unique_ptr<SpatialFilter> acuity =
      plan.acuity ? acuity_filter(acuity_choice, parameters, resolution, console) : nullptr;

  if (acuity) check_acuity_memory(*acuity, *source, layout, options.image.limits);

  const ChosenWay way = settle(precision, parameters, has_receptors(layout), console);
  std::vector<Attribute> stamps = stamps_of(parameters, choice, layout);
  stamps.push_back({"scotopic:precision", way.name});
  if (acuity) stamps.push_back({"scotopic:acuityPixelsPerDegree", resolution.pixels_per_degree});
  correct_stamps(stamps, display_choice, layout);
  const NonFiniteWatch watch(non_finite);
  const RowOperator apply = watch.watched(plan.nothing() ? RowOperator{} : way.apply);
  SpatialFilters filters;
  if (acuity) filters.push_back(acuity.get());
  const DisplayStage display =
      display_stage(display_choice, parameters, *source, layout, config, apply, filters, console);
  if (display.filter) filters.push_back(display.filter.get());
  stamps.insert(stamps.end(), display.stamps.begin(), display.stamps.end());
  set_stamps(layout, stamps);
  apply_image(*source, layout, config, apply, file, nullptr, filters);
  nlohmann::ordered_json result = result_of(options, numbers, layout, stamps, *source);
  result["effects"] = plan_json(plan);
  result["nonFinite"] = report_non_finite(watch, non_finite, *source, layout, config, console);
  if (!way.report.is_null()) result["ways"] = way.report;
  if (!display.report.is_null()) result["display"] = display.report;
  console.result(result);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_apply(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<ApplyOptions>();
  CLI::App& verb = *program.add_subcommand("apply", "An image as the dark-adapted eye sees it");
  verb.footer("Example: scotopic apply night.exr -o seen.exr --adaptation 0.05");
  verb.add_option("input", options->input, "EXR, TIFF, PNG, JPEG or HDR: RGB, L, M, S, R, or spectral bands")
      ->required()
      ->type_name("IN");
  verb.add_option("-o,--output", options->output, "EXR, TIFF, PNG or JPEG, by its extension")
      ->required()
      ->type_name("OUT");
  add_operator_options(verb, options->appearance);
  add_precision_options(verb, options->precision);
  add_band_options(verb, options->bands);
  add_acuity_options(verb, options->acuity);
  add_display_options(verb, options->display);
  verb.add_option("--nonfinite", options->non_finite, "NaN and infinite pixels: keep, clean (to 0), or error")
      ->type_name("WHAT");
  add_input_options(verb, options->image);
  add_output_options(verb, options->image);
  add_icc_options(verb, options->icc);
  add_common_options(verb, options->common);
  on_command_line(verb, invocation, options, run_apply);
}

}  // namespace scotopic

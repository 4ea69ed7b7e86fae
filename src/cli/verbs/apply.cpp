// scotopic apply: an image as the dark-adapted eye sees it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/options/display_options.h"
#include "cli/options/icc_options.h"
#include "cli/report/non_finite_report.h"
#include "cli/program.h"
#include "cli/sequence/recipe.h"
#include "cli/sequence/run_frames.h"
#include "cli/scene/glare_options.h"
#include "cli/scene/scene_plan.h"
#include "cli/scene/scene_settings.h"
#include "cli/sequence/shot.h"
#include "cli/options/values.h"
#include "cli/scene/way_keeper.h"
#include "pipeline/acuity_rows.h"
#include "pipeline/apply_image.h"

namespace scotopic {
namespace {

struct ApplyOptions {
  std::string input;
  std::string output;
  SceneOptions scene;
  std::string adaptation_from;
  PrecisionOptions precision;
  DisplayOptions display;
  GlareOptions glare;
  IccOptions icc;
  std::string non_finite = "keep";
  FrameOptions frames;
  CommonOptions common;
};

std::vector<Attribute> parameter_stamps(const AppearanceParameters& p, const OperatorChoice& choice,
                                        const ImageLayout& layout) {
  const ColourChannels::Kind kind = layout.light.front().channels.kind;
  const bool own = kind == ColourChannels::Kind::lmsr || kind == ColourChannels::Kind::computed;
  std::vector<Attribute> stamps = {{"scotopic:version", std::string(SCOTOPIC_VERSION)},
                                   {"scotopic:model", model_name(p.model)},
                                   {"scotopic:adaptation", p.adaptation},
                                   {"scotopic:sceneWhiteLuminance", p.white_luminance},
                                   {"scotopic:strength", p.strength.all},
                                   {"scotopic:strengthShift", p.strength.shift},
                                   {"scotopic:strengthLuminance", p.strength.luminance},
                                   {"scotopic:strengthChroma", p.strength.chroma},
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

nlohmann::ordered_json result_of(const FramePaths& paths, const SceneNumbers& numbers,
                                 const ImageLayout& layout, const std::vector<Attribute>& stamps,
                                 const PixelSource& source) {
  nlohmann::ordered_json out;
  out["input"] = paths.input;
  out["output"] = paths.output;
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

NonFinite non_finite_policy(const std::string& text) {
  return choice<NonFinite>("--nonfinite", text,
                           {{"keep", NonFinite::keep}, {"clean", NonFinite::clean}, {"error", NonFinite::error}});
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
    check_limit(source.file(), "bytes of memory planned", planned_bytes(picture) + acuity_bytes(acuity, picture, layout.wraps),
                limits.memory, "--max-memory");
  }
}

class ApplyJob : public FrameJob {
 public:
  ApplyJob(const ApplyOptions& options, const Console& console);

  SceneSettings& scene() { return settings_; }
  /// Whether the tone map of each image follows that image.
  bool measures_display() const { return display_.tone && !display_.range; }
  std::string settings() const override;
  const Limits& limits() const override { return settings_.limits; }
  nlohmann::ordered_json run(const FrameTask& task, const Console& console) override;

 private:
  /// One image: what it holds, and what is done to it.
  struct Seen {
    Scene scene;
    SceneNumbers numbers;
    AngularResolution resolution;
    ScenePlan plan;
    GlareOutcome glare;
  };

  Seen look(const FramePaths& paths, const Console& console) const;
  void add_glare(Seen& frame, std::optional<SceneStatistics>& statistics) const;
  std::vector<Attribute> stamps_of(const Seen& frame, const std::string& way, const std::string& recipe) const;

  WayKeeper ways_;
  NonFinite non_finite_;
  ImageRequest asked_;
  DisplayChoice display_;
  GlareChoice glare_;
  SceneSettings settings_;
};

ApplyJob::ApplyJob(const ApplyOptions& o, const Console& console)
    : ways_(understand(o.precision)),
      non_finite_(non_finite_policy(o.non_finite)),
      asked_(understand(o.scene.image)),
      display_(understand(o.display, asked_)),
      glare_(understand(o.glare)),
      settings_((understand(o.icc, asked_), o.scene), o.common.threads) {
  settings_.request = asked_;
  if (asked_.view) settings_.config = settings_.config.holding(*asked_.view);
  check_view(asked_, settings_.config, console);
  if (const std::string idle = without_effect(o.scene.appearance, settings_.choice.parameters); !idle.empty())
    console.note("without effect under --model safko2019: " + idle);
}

std::string ApplyJob::settings() const {
  const std::optional<double>& adaptation = settings_.choice.adaptation;
  return colour_identity(settings_.config) + (adaptation ? fmt::format(" {:a}", *adaptation) : "");
}

/// Opens the image and decides what is computed, after a look at the pixels where the options leave that to them.
/// Glare comes first: its threshold rests on the adaptation as given, or metered on the picture; what follows on what the
/// picture is with it.
void ApplyJob::add_glare(Seen& frame, std::optional<SceneStatistics>& statistics) const {
  const OperatorChoice& choice = settings_.choice;
  Scene& scene = frame.scene;
  NightDisplayParameters shown = display_.night;
  shown.adaptation = frame.numbers.adaptation;
  shown.white_luminance = frame.numbers.white_luminance;
  frame.glare = scatter(glare_, choice.parameters.model == Model::safko2019 ? EffectWish::no : choice.glare,
                        1 / display_scale(shown), *scene.source, scene.layout, settings_.config, choice.parameters,
                        frame.resolution, is_panorama(settings_.acuity, *scene.source, scene.layout), settings_.limits);
  const auto first = frame.glare.frames.find(scene.layout.light.front().index);
  if (!statistics || first == frame.glare.frames.end()) return;
  const Picture& picture = scene.source->pictures()[first->first];
  statistics = measure_frame(first->second, picture, choice.parameters, choice.metering.region);
  if (!choice.adaptation)
    frame.numbers = settle(scene.known, metered(*statistics, choice.metering), scene.source->file());
}

ApplyJob::Seen ApplyJob::look(const FramePaths& paths, const Console& console) const {
  Seen frame;
  Scene& scene = frame.scene;
  scene = open_scene(settings_, paths.input, paths.output, console);
  PixelSource& source = *scene.source;
  refuse_idle_options(display_, scene.layout);
  describe_layout(source, settings_.config, scene.layout, console);
  if (non_finite_ == NonFinite::error) refuse_non_finite(source, scene.layout, settings_.config);
  const MeteredScene metered = meter(scene, settings_, false);
  frame.numbers = metered.numbers;
  frame.resolution = angular_resolution(settings_.acuity, source, scene.layout);
  scene.layout.wraps = is_panorama(settings_.acuity, source, scene.layout);
  std::optional<SceneStatistics> statistics = metered.statistics;
  add_glare(frame, statistics);
  console.note(source.file() + ": " + describe(frame.numbers));
  OperatorChoice choice = settings_.choice;
  choice.parameters.adaptation = frame.numbers.adaptation;
  choice.parameters.white_luminance = frame.numbers.white_luminance;
  const PlanRequest request = plan_request(choice, settings_.acuity, frame.resolution);
  if (request.acuity && !frame.resolution.known)
    throw Error(ExitCode::usage, source.file(), "detail needs pixels per degree, which are not known: --fov or --ppd");
  frame.plan = plan_of(choice, request, statistics ? &*statistics : nullptr);
  replace_decision(frame.plan, frame.glare.decision);
  console.note(source.file() + ": " + plan_line(frame.plan));
  return frame;
}

std::vector<Attribute> ApplyJob::stamps_of(const Seen& frame, const std::string& way, const std::string& recipe) const {
  std::vector<Attribute> stamps = parameter_stamps(frame.plan.parameters, settings_.choice, frame.scene.layout);
  stamps.push_back({"scotopic:precision", way});
  if (frame.plan.acuity)
    stamps.push_back({"scotopic:acuityPixelsPerDegree", frame.resolution.pixels_per_degree});
  if (!recipe.empty()) stamps.push_back({recipe_attribute, recipe});
  return stamps;
}

nlohmann::ordered_json ApplyJob::run(const FrameTask& task, const Console& console) {
  OutputFile file(task.paths.output);
  Seen frame = look(task.paths, console);
  PixelSource& source = *frame.scene.source;
  ImageLayout& layout = frame.scene.layout;
  const AppearanceParameters& parameters = frame.plan.parameters;
  const std::unique_ptr<SpatialFilter> acuity =
      frame.plan.acuity ? acuity_filter(settings_.acuity, parameters, frame.resolution, console) : nullptr;
  if (acuity) check_acuity_memory(*acuity, source, layout, settings_.limits);
  const ChosenWay way = ways_.way(parameters, has_receptors(layout), console);
  std::vector<Attribute> stamps = stamps_of(frame, way.name, task.recipe);
  correct_stamps(stamps, display_, layout);
  const NonFiniteWatch watch(non_finite_);
  const RowOperator apply = watch.watched(frame.plan.nothing() ? RowOperator{} : way.apply);
  SpatialFilters filters;
  if (acuity) filters.push_back(acuity.get());
  const DisplayStage display =
      display_stage(display_, parameters, source, layout, settings_.config, apply, filters, console);
  if (display.filter) filters.push_back(display.filter.get());
  const Precision precision = way.name == "double" ? Precision::dual : Precision::single;
  const ShownNight night = night_stage(display_, parameters, precision, source.file(), layout, console);
  const RowOperator show = night.batch ? RowOperator([&](const PixelRows& rows, std::uint8_t* touched) {
    night.batch->apply(rows, touched);
  }) : RowOperator();
  for (const std::vector<Attribute>* more : {&display.stamps, &night.stamps, static_cast<const std::vector<Attribute>*>(&frame.glare.stamps)})
    stamps.insert(stamps.end(), more->begin(), more->end());
  set_stamps(layout, stamps);
  const std::uint64_t unseen = apply_image(source, layout, settings_.config, apply, file, task.progress, filters, show,
                                           frame.glare.frames.empty() ? nullptr : &frame.glare.frames);
  nlohmann::ordered_json result = result_of(task.paths, frame.numbers, layout, stamps, source);
  result["effects"] = plan_json(frame.plan);
  result["nonFinite"] = report_non_finite(
      unseen + watch.count(), non_finite_ == NonFinite::clean ? "cleaned" : "passed on without the operator (--nonfinite)", source,
      layout, settings_.config, console);
  if (!way.report.is_null()) result["ways"] = way.report;
  if (!display.report.is_null()) result["display"] = display.report;
  if (!night.report.is_null()) result["display"] = night.report;
  return result;
}

int run_apply(const ApplyOptions& options) {
  const Console console(options.common);
  (void)output_format(options.output);
  const std::vector<Frame> frames = frames_of(options.frames, options.input, options.output);
  ApplyJob job(options, console);
  check_shot(options.adaptation_from, job.scene().choice, frames);
  check_places(frames, options.frames);
  settle_shot(options.adaptation_from, job.scene(), frames, options.frames, console);
  if (frames.size() > 1 && job.measures_display())
    console.note("each frame's range is mapped to the display by itself, which can flicker: --display-range holds one");
  return run_frames("apply", job, frames, options.frames, console);
}

}  // namespace

void add_apply(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<ApplyOptions>();
  CLI::App& verb = *program.add_subcommand("apply", "An image as the dark-adapted eye sees it");
  verb.footer(
      "Examples:\n"
      "  scotopic apply night.exr -o seen.exr --adaptation 0.05\n"
      "  scotopic apply in.####.exr -o seen.####.exr --frames 1-240 --adaptation-from frames --white-luminance 5");
  verb.add_option("input", options->input, "EXR, TIFF, PNG, JPEG or HDR: RGB, L, M, S, R, or spectral bands")
      ->required()
      ->type_name("IN");
  verb.add_option("-o,--output", options->output, "EXR, TIFF, PNG or JPEG, by its extension")
      ->required()
      ->type_name("OUT");
  SceneOptions& scene = options->scene;
  add_operator_options(verb, scene.appearance);
  add_shot_options(verb, options->adaptation_from);
  add_frame_options(verb, options->frames);
  add_precision_options(verb, options->precision);
  add_band_options(verb, scene.bands);
  add_acuity_options(verb, scene.acuity);
  add_display_options(verb, options->display);
  add_glare_options(verb, options->glare);
  verb.add_option("--nonfinite", options->non_finite, "NaN and infinite pixels: keep, clean (to 0), or error")
      ->type_name("WHAT");
  add_input_options(verb, scene.image);
  add_output_options(verb, scene.image);
  add_icc_options(verb, options->icc);
  add_common_options(verb, options->common);
  on_command_line(verb, invocation, options, run_apply);
}

}  // namespace scotopic

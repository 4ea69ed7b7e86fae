#include "pipeline/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "io/atomic/output_file.h"
#include "io/row_bands.h"
#include "pipeline/rows/acuity_rows.h"
#include "pipeline/scene/open_image.h"
#include "pipeline/scene/scene_plan.h"
#include "pipeline/scene/stamps.h"
#include "pipeline/stages/frame_stages.h"

namespace scotopic {
namespace {

void follow_track(const ImageJob& job, KnownNumbers& known) {
  if (!job.adaptation) return;
  known.adaptation = job.adaptation->luminance;
  known.adaptation_source = job.adaptation->source;
}

/// Numbers of a scene, by one pass over its light where they are not known.
SceneNumbers meter(OpenImage& image, const ImageSettings& s, Statistics wanted, const FrameLights* frames,
                   SceneReport& out) {
  const AdaptationMethod& method = s.choice.metering;
  const bool metered_here = needs_measurement(image.known, image.source->file());
  const bool whole = wanted == Statistics::of_all_pixels || (metered_here && !method.region);
  MeterRequest request{whole, metered_here ? method.region : std::nullopt};
  if (!request.whole && !request.region) return settle(image.known, 0, image.source->file());
  MeasuredLight light =
      measure_light(*image.source, image.layout, s.config, s.choice.parameters, request, frames);
  if (s.non_finite == NonFinite::error) refuse(light.non_finite, image.source->file());
  const double adapted = metered_here ? metered(request.region ? light.region : light.whole, method) : 0;
  out.non_finite = light.non_finite;
  out.statistics = whole ? std::move(light.whole) : std::move(light.region);
  return settle(image.known, adapted, image.source->file());
}

PlanRequest request_for(const ImageSettings& s, const SceneNumbers& numbers,
                        const AngularResolution& resolution) {
  const AppearanceParameters scene = parameters_of(s.choice, numbers.adaptation, numbers.white_luminance);
  return plan_request(s.choice, scene, s.acuity, resolution);
}

void plan(OpenImage& image, const ImageSettings& s, SceneReport& scene) {
  scene.resolution = angular_resolution(s.acuity, *image.source, image.layout);
  scene.request = request_for(s, scene.numbers, scene.resolution);
}

void decide(const ImageSettings& s, const std::vector<EffectDecision>& of_frames, SceneReport& scene) {
  scene.plan = plan_of(s.choice, scene.request, scene.statistics ? &*scene.statistics : nullptr);
  for (const EffectDecision& decision : of_frames) set_decision(scene.plan, decision);
}

/// The scene's numbers: what frame stages change, they change before the eye adapts to it.
void see_scene(OpenImage& image, const ImageSettings& s, Statistics wanted, FramesOfImage& frames,
               SceneReport& scene) {
  scene.numbers = meter(image, s, wanted, frames.lights(), scene);
  if (frames.any() && frames.run(scene.numbers))
    scene.numbers = meter(image, s, wanted, frames.lights(), scene);
  frames.forget_unchanged();
}

/// Of the filter and of the rest, before either is allocated.
void check_acuity_memory(const SpatialFilter& acuity, const OpenImage& image, const Limits& limits,
                         std::int64_t frames) {
  for (const LightPicture& light : image.layout.light) {
    const Picture& picture = image.source->pictures()[light.index];
    check_limit(image.source->file(), "bytes of memory planned",
                frames + planned_bytes(picture) + acuity_bytes(acuity, picture, image.layout.wraps),
                limits.memory, "--max-memory");
  }
}

/// The stages of one image, made for its scene.
class ImageRun {
 public:
  ImageRun(const ImageJob& job, const ImageSettings& settings, EvaluatorSource& evaluators,
           const Notes& notes)
      : job_(job), settings_(settings), evaluators_(evaluators), notes_(notes), file_(job.output) {}

  ImageReport run() {
    OpenImage image = open_image(settings_, job_.input, job_.output, notes_);
    follow_track(job_, image.known);
    refuse_idle_options(settings_.display, image.layout);
    describe_layout(*image.source, settings_.config, image.layout, notes_);
    FramesOfImage frames(image, settings_, job_.moment, notes_);
    look(image, frames);
    make_stages(image, frames);
    report_.non_finite =
        apply_image(*image.source, image.layout, settings_.config, stages_, file_, job_.progress);
    describe(image);
    return std::move(report_);
  }

 private:
  /// Decides what is computed, after a look at the pixels where the settings leave that to them.
  void look(OpenImage& image, FramesOfImage& frames) {
    SceneReport& scene = report_.scene;
    const std::string& file = image.source->file();
    see_scene(image, settings_, Statistics::where_needed, frames, scene);
    notes_.note(file + ": " + scotopic::describe(scene.numbers));
    plan(image, settings_, scene);
    if (scene.request.acuity && !scene.resolution.known)
      throw Error(ExitCode::usage, file,
                  "detail needs pixels per degree, which are not known: --fov or --ppd");
    decide(settings_, frames.decisions(), scene);
    notes_.note(file + ": " + plan_line(scene.plan));
  }

  void make_stages(OpenImage& image, const FramesOfImage& frames) {
    const AppearanceParameters& parameters = report_.scene.plan.parameters;
    stages_.non_finite = settings_.non_finite;
    stages_.frames = frames.lights();
    stages_.scene = parameters;
    stages_.moment = job_.moment;
    if (report_.scene.plan.acuity) add_acuity(image, frames, parameters);
    report_.evaluator = evaluators_.evaluator(parameters, image.has_receptors(), notes_);
    if (!report_.scene.plan.nothing()) stages_.evaluator = report_.evaluator.get();
    report_.stamps = stamps(image);
    add_rows(image, parameters);
    add_display(image, parameters);
    report_.stamps.insert(report_.stamps.end(), frames.stamps().begin(), frames.stamps().end());
    set_stamps(image.layout, report_.stamps);
  }

  void add_acuity(const OpenImage& image, const FramesOfImage& frames,
                  const AppearanceParameters& parameters) {
    acuity_ = acuity_filter(settings_.acuity, parameters, report_.scene.resolution, notes_);
    check_acuity_memory(*acuity_, image, settings_.limits, frames.bytes());
    stages_.filters.push_back(acuity_.get());
  }

  void add_rows(const OpenImage& image, const AppearanceParameters& parameters) {
    const StageScene scene = {parameters, report_.scene.resolution, image.layout.wraps};
    for (const RowStageMaker& make : settings_.row_stages)
      if (auto stage = make(scene)) stages_.after.push_back(rows_.emplace_back(std::move(stage)).get());
  }

  void add_display(OpenImage& image, const AppearanceParameters& parameters) {
    tone_ = tone_stage(settings_.display, parameters, *image.source, image.layout, settings_.config, stages_,
                       notes_);
    if (tone_.filter) stages_.filters.push_back(tone_.filter.get());
    night_ = night_stage(settings_.display, parameters, report_.evaluator->precision(), image.source->file(),
                         image.layout, notes_);
    if (night_.rows) stages_.after.push_back(night_.rows.get());
    for (const auto* more : {&tone_.stamps, &night_.stamps})
      report_.stamps.insert(report_.stamps.end(), more->begin(), more->end());
    report_.tone = tone_.report;
    report_.night = night_.report;
  }

  std::vector<Attribute> stamps(const OpenImage& image) const {
    const SceneReport& scene = report_.scene;
    std::vector<Attribute> out = parameter_stamps(scene.plan.parameters, settings_.choice, image.layout);
    out.push_back({"scotopic:precision", report_.evaluator->name()});
    if (scene.plan.acuity)
      out.push_back({"scotopic:acuityPixelsPerDegree", scene.resolution.pixels_per_degree});
    if (!job_.provenance.empty()) out.push_back({provenance_attribute, job_.provenance});
    correct_stamps(out, settings_.display, image.layout);
    return out;
  }

  void describe(const OpenImage& image) {
    const LightPicture& light = image.layout.light.front();
    report_.input = job_.input;
    report_.output = job_.output;
    report_.input_space = light.space.name;
    report_.input_space_reason = light.space_reason;
    report_.output_space = image.layout.output_space.name;
    report_.notes = image.layout.notes;
    report_.scene.spectral = spectral_report_of(*image.source);
  }

  const ImageJob& job_;
  const ImageSettings& settings_;
  EvaluatorSource& evaluators_;
  const Notes& notes_;
  OutputFile file_;
  ImageStages stages_;
  std::unique_ptr<SpatialFilter> acuity_;
  std::vector<std::unique_ptr<const RowStage>> rows_;
  ToneStage tone_;
  NightStage night_;
  ImageReport report_;
};

}  // namespace

ImageReport run_image(const ImageJob& job, const ImageSettings& settings, EvaluatorSource& evaluators,
                      const Notes& notes) {
  return ImageRun(job, settings, evaluators, notes).run();
}

SceneReport read_scene(const ImageJob& job, const ImageSettings& settings, Statistics wanted,
                       const Notes& notes) {
  OpenImage image = open_to_read(settings, job.input, notes);
  follow_track(job, image.known);
  FramesOfImage frames(image, settings, job.moment, notes);
  SceneReport scene;
  see_scene(image, settings, wanted, frames, scene);
  plan(image, settings, scene);
  decide(settings, frames.decisions(), scene);
  scene.spectral = spectral_report_of(*image.source);
  return scene;
}

ScenePlan plan_for(const ImageSettings& settings, const SceneNumbers& numbers,
                   const AngularResolution& resolution, const SceneStatistics* statistics) {
  return plan_of(settings.choice, request_for(settings, numbers, resolution), statistics);
}

}  // namespace scotopic

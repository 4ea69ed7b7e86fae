#include "pipeline/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "io/atomic/output_file.h"
#include "io/pixels/row_bands.h"
#include "pipeline/rows/acuity_rows.h"
#include "pipeline/scene/open_image.h"
#include "pipeline/scene/scene_plan.h"
#include "pipeline/scene/stamps.h"
#include "pipeline/stages/frame_stages.h"
#include "stages/time/description.h"

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
  if (!request.whole && !request.region) return resolve_numbers(image.known, 0, image.source->file());
  MeasuredLight light =
      measure_light(*image.source, image.layout, s.config, s.choice.parameters, request, frames);
  if (s.non_finite == NonFinite::error) refuse(light.non_finite, image.source->file());
  const double adapted = metered_here ? metered(request.region ? light.region : light.whole, method) : 0;
  out.non_finite = light.non_finite;
  out.statistics = whole ? std::move(light.whole) : std::move(light.region);
  return resolve_numbers(image.known, adapted, image.source->file());
}

/// The eye's state at this moment, where light before the scene has left one.
std::optional<AdaptationTrace> trace_of(const ImageJob& job, const ImageSettings& s, double adaptation) {
  AdaptationState state;
  if (job.adaptation && job.adaptation->state)
    state = *job.adaptation->state;
  else if (!s.time.history.empty())
    state = state_after(state_after(s.time.history), adaptation, job.moment.seconds);
  else
    return std::nullopt;
  return AdaptationTrace{state, thresholds_of(state, adaptation)};
}

/// What stages are told, once the scene's numbers are known.
StageScene stage_scene(const ImageSettings& s, const SceneReport& scene, bool wraps, bool tracked) {
  StageScene out;
  out.parameters = scene.asked;
  out.resolution = scene.resolution;
  out.wraps = wraps;
  out.sequence = s.sequence;
  out.tracked = tracked;
  out.adapting = scene.adapting;
  return out;
}

template <class Stages>
void decide(const Stages& stages, const StageScene& scene, std::vector<EffectDecision>& out) {
  for (const auto& stage : stages) out.push_back(stage->decide(scene));
}

/// Decides what is computed.
void plan(const ImageJob& job, OpenImage& image, const ImageSettings& s,
          const std::vector<EffectDecision>& of_frames, SceneReport& scene) {
  const SceneNumbers& numbers = scene.numbers;
  scene.resolution = angular_resolution(s.viewing, *image.source, image.layout);
  scene.asked = parameters_of(s.choice, numbers.adaptation, numbers.white_luminance);
  scene.adapting = trace_of(job, s, numbers.adaptation);
  std::vector<EffectDecision> decided = of_frames;
  const StageScene of_stages = stage_scene(s, scene, image.layout.wraps, job.adaptation.has_value());
  try {
    decide(s.light_stages, of_stages, decided);
    decide(s.filter_stages, of_stages, decided);
    decide(s.point_stages, of_stages, decided);
  } catch (const Error& error) {
    throw Error(error.code(), image.source->file(), error.what());
  }
  scene.plan = plan_of(s.choice, scene.asked, scene.statistics ? &*scene.statistics : nullptr, decided);
  if (scene.adapting && scene.plan.effect(time_description.name).runs())
    scene.plan.parameters.rod_adaptation = scene.adapting->thresholds.rod_luminance;
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
void check_filter_memory(const SpatialFilter& filter, const OpenImage& image, const Limits& limits,
                         std::int64_t frames) {
  for (const LightSubimage& light : image.layout.light) {
    const Subimage& subimage = image.source->subimages()[light.index];
    const auto layers = static_cast<std::int64_t>(image.layout.lights_of(light.index).size());
    check_limit(
        image.source->file(), "bytes of memory planned",
        frames + planned_bytes(subimage) + layers * acuity_bytes(filter, subimage, image.layout.wraps),
        limits.memory, "--max-memory");
  }
}

/// From file to file.
class FileEnds : public ImageEnds {
 public:
  explicit FileEnds(const ImageJob& job) : job_(job), file_(job.output) {}
  OpenImage open(const ImageSettings& settings, const Notes& notes) override {
    return open_image(settings, job_.input, job_.output, notes);
  }
  NonFinitePixels write(OpenImage& image, const ColourConfig& config, const ImageStages& stages,
                        const Progress& progress) override {
    return apply_image(*image.source, image.layout, config, stages, file_, progress);
  }

 private:
  const ImageJob& job_;
  OutputFile file_;
};

/// The stages of one image, made for its scene.
class ImageRun {
 public:
  ImageRun(const ImageJob& job, ImageEnds& ends, const ImageSettings& settings, EvaluatorSource& evaluators,
           const Notes& notes)
      : job_(job), ends_(ends), settings_(settings), evaluators_(evaluators), notes_(notes) {}

  ImageReport run() {
    OpenImage image = ends_.open(settings_, notes_);
    follow_track(job_, image.known);
    set_moment(image);
    refuse_idle_options(settings_.display, image.layout);
    describe_layout(*image.source, settings_.config, image.layout, notes_);
    FramesOfImage frames(image, settings_, job_.moment, notes_);
    look(image, frames);
    make_stages(image, frames);
    std::atomic<std::uint64_t> clipped = 0, behind_alpha = 0;
    stages_.clipped = &clipped;
    stages_.behind_alpha = &behind_alpha;
    report_.non_finite = ends_.write(image, settings_.config, stages_, job_.progress);
    report_.clipped = told_share(image, clipped, "are clipped to what the output's type holds");
    told_share(image, behind_alpha,
               "are light beside an alpha of 0, which straight alpha hides: EXR keeps it, JPEG shows it");
    describe(image);
    return std::move(report_);
  }

 private:
  /// Decides what is computed, after a look at the pixels where the settings leave that to them.
  void look(OpenImage& image, FramesOfImage& frames) {
    SceneReport& scene = report_.scene;
    const std::string& file = image.source->file();
    see_scene(image, settings_, Statistics::where_needed, frames, scene);
    notes_.note(file + ": " + space_text(image.layout));
    notes_.note(file + ": " + scotopic::describe(scene.numbers));
    plan(job_, image, settings_, frames.decisions(), scene);
    notes_.note(file + ": " + plan_line(scene.plan));
  }

  /// Says it, if there is something to say.
  double told_share(const OpenImage& image, std::uint64_t count, std::string_view are) {
    std::uint64_t pixels = 0;
    for (const LightSubimage& light : image.layout.light) {
      const Window& data = image.source->subimages()[light.index].data;
      pixels += static_cast<std::uint64_t>(data.width()) * static_cast<std::uint64_t>(data.height());
    }
    const double share = static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(pixels, 1));
    if (count > 0)
      notes_.note(fmt::format("{}: {:.2g} % of its pixels {}", image.source->file(), 100 * share, are));
    return share;
  }

  /// Said where it matters: seconds are of noise and time alone.
  void set_moment(const OpenImage& image) {
    if (!settings_.sequence) return;
    const FrameRate rate = frame_rate(settings_.choice.stages, *image.source);
    job_.moment.seconds = job_.moment.frame / rate.rate;
    notes_.detail(fmt::format("{}: {:g} frames a second ({})", image.source->file(), rate.rate, rate.source));
  }

  void make_stages(OpenImage& image, const FramesOfImage& frames) {
    const AppearanceParameters& parameters = report_.scene.plan.parameters;
    stages_.non_finite = settings_.non_finite;
    stages_.frames = frames.lights();
    stages_.moment = job_.moment;
    report_.evaluator = evaluators_.evaluator(parameters, image.has_receptors(), notes_);
    if (pixel_stages_run()) stages_.evaluator = report_.evaluator.get();
    report_.stamps = stamps(image);
    scene_ = stage_scene(settings_, report_.scene, image.layout.wraps, job_.adaptation.has_value());
    scene_.parameters.rod_adaptation = parameters.rod_adaptation;
    scene_.precision = report_.evaluator->precision();
    add_light();
    add_filters(image, frames);
    add_points();
    add_display(image, parameters);
    add_stamps(frames.stamps());
    set_stamps(image.layout, report_.stamps);
  }

  /// Those of the fused loop.
  bool pixel_stages_run() const {
    const StageTable table = settings_.choice.stages.table();
    for (const EffectDecision& d : report_.scene.plan.effects) {
      const std::size_t place = place_of(table, d.effect);
      if (d.runs() && place < table.size() && table[place].set) return true;
    }
    return false;
  }

  void add_stamps(const std::vector<Attribute>& more) {
    report_.stamps.insert(report_.stamps.end(), more.begin(), more.end());
  }

  void add_light() {
    for (const auto& stage : settings_.light_stages) {
      if (!report_.scene.plan.effect(stage->name()).runs()) continue;
      const LightMatrices next = stage->matrices(scene_);
      const LightMatrices before = stages_.light.value_or(LightMatrices());
      stages_.light = {next.rgb * before.rgb, next.lms * before.lms, next.luminance};
      add_stamps(stage->stamps(scene_));
    }
  }

  void add_filters(const OpenImage& image, const FramesOfImage& frames) {
    for (const auto& stage : settings_.filter_stages) {
      if (!report_.scene.plan.effect(stage->name()).runs()) continue;
      filters_.push_back(stage->make(scene_, notes_));
      check_filter_memory(*filters_.back(), image, settings_.limits, frames.bytes());
      stages_.filters.push_back(filters_.back().get());
      add_stamps(stage->stamps(scene_));
    }
  }

  void add_points() {
    for (const auto& stage : settings_.point_stages) {
      if (!report_.scene.plan.effect(stage->name()).runs()) continue;
      stages_.after.push_back(rows_.emplace_back(stage->make(scene_, notes_)).get());
      add_stamps(stage->stamps(scene_));
    }
  }

  void add_display(OpenImage& image, const AppearanceParameters& parameters) {
    tone_ = tone_stage(settings_.display, parameters, *image.source, image.layout, settings_.config, stages_,
                       notes_);
    if (tone_.filter) stages_.filters.push_back(tone_.filter.get());
    night_ = night_stage(settings_.choice.stages, parameters, report_.evaluator->precision(),
                         image.source->file(), image.layout, notes_);
    if (night_.rows) stages_.after.push_back(night_.rows.get());
    add_stamps(tone_.stamps);
    add_stamps(night_.stamps);
    report_.tone = tone_.report;
    report_.night = night_.report;
  }

  std::vector<Attribute> stamps(const OpenImage& image) const {
    const SceneReport& scene = report_.scene;
    std::vector<Attribute> out = parameter_stamps(scene.plan.parameters, settings_.choice, image.layout);
    out.push_back({"scotopic:precision", report_.evaluator->name()});
    if (!job_.provenance.empty()) out.push_back({provenance_attribute, job_.provenance});
    correct_stamps(out, settings_.display, image.layout);
    return out;
  }

  void describe(const OpenImage& image) {
    const LightSubimage& light = image.layout.light.front();
    report_.input = job_.input;
    report_.output = job_.output;
    report_.input_space = light.space.name;
    report_.input_space_reason = light.space_reason;
    report_.output_space = image.layout.output_space.name;
    report_.notes = image.layout.notes;
    report_.scene.spectral = spectral_report_of(*image.source);
  }

  ImageJob job_;
  ImageEnds& ends_;
  const ImageSettings& settings_;
  EvaluatorSource& evaluators_;
  const Notes& notes_;
  ImageStages stages_;
  StageScene scene_;
  std::vector<std::unique_ptr<SpatialFilter>> filters_;
  std::vector<std::unique_ptr<const RowStage>> rows_;
  ToneStage tone_;
  NightStage night_;
  ImageReport report_;
};

}  // namespace

ImageReport run_image(const ImageJob& job, const ImageSettings& settings, EvaluatorSource& evaluators,
                      const Notes& notes) {
  FileEnds ends(job);
  return run_image(job, ends, settings, evaluators, notes);
}

ImageReport run_image(const ImageJob& job, ImageEnds& ends, const ImageSettings& settings,
                      EvaluatorSource& evaluators, const Notes& notes) {
  return ImageRun(job, ends, settings, evaluators, notes).run();
}

SceneReport read_scene(const ImageJob& job, const ImageSettings& settings, Statistics wanted,
                       const Notes& notes) {
  OpenImage image = open_to_read(settings, job.input, notes);
  SceneReport scene = read_scene(image, job, settings, wanted, notes);
  describe_layout(*image.source, settings.config, image.layout, notes);
  notes.note(image.source->file() + ": " + input_space_text(image.layout));
  return scene;
}

SceneReport read_scene(OpenImage& image, const ImageJob& asked, const ImageSettings& settings,
                       Statistics wanted, const Notes& notes) {
  ImageJob job = asked;
  follow_track(job, image.known);
  SceneReport scene;
  scene.frame_rate = frame_rate(settings.choice.stages, *image.source).rate;
  if (settings.sequence) job.moment.seconds = job.moment.frame / scene.frame_rate;
  FramesOfImage frames(image, settings, job.moment, notes);
  see_scene(image, settings, wanted, frames, scene);
  plan(job, image, settings, frames.decisions(), scene);
  scene.spectral = spectral_report_of(*image.source);
  return scene;
}

FrameRate frame_rate(const StageValues& values, const PixelSource& source) {
  if (values.number("fps") > 0) return {values.number("fps"), "--fps"};
  for (const Attribute& a : source.attributes(0)) {
    const auto* const rate = std::get_if<double>(&a.value);
    if (a.name == "framesPerSecond" && rate && *rate > 0) return {*rate, "the file's"};
  }
  return {};
}

ScenePlan plan_for(const ImageSettings& settings, const SceneNumbers& numbers,
                   const AngularResolution& resolution, const SceneStatistics* statistics) {
  SceneReport scene;
  scene.asked = parameters_of(settings.choice, numbers.adaptation, numbers.white_luminance);
  scene.resolution = resolution;
  const StageScene of_stages = stage_scene(settings, scene, false, true);
  std::vector<EffectDecision> decided;
  decide(settings.light_stages, of_stages, decided);
  decide(settings.filter_stages, of_stages, decided);
  decide(settings.point_stages, of_stages, decided);
  return plan_of(settings.choice, scene.asked, statistics, decided);
}

}  // namespace scotopic

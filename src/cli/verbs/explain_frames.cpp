#include "cli/verbs/explain_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "base/names.h"
#include "cli/sequence/adaptation_track.h"
#include "cli/sequence/in_order.h"
#include "cli/sequence/progress_line.h"
#include "cli/sequence/run_frames.h"
#include "cli/sequence/shot_adaptation.h"
#include "pipeline/run.h"
#include "report/image_report.h"

namespace scotopic {
namespace {

std::string effects_text(const std::vector<std::string>& effects) {
  return effects.empty() ? "nothing" : joined(effects);
}

std::vector<std::string> running_effects(const ScenePlan& plan) {
  std::vector<std::string> effects;
  for (const EffectDecision& d : plan.effects)
    if (d.runs()) effects.emplace_back(d.effect);
  return effects;
}

/// What is kept of a frame, or why there is nothing.
struct Metered {
  FrameLight light;
  AngularResolution resolution;
  double frame_rate = 24;
  std::optional<Error> failure;
  std::vector<std::string> notes;
};

void meter_one(const ImageSettings& settings, const Frame& frame, const Console& console, Metered& out) {
  ImageJob job;
  job.input = frame.paths.input;
  job.moment.frame = *frame.number;
  const SceneReport scene = read_scene(job, settings, Statistics::of_all_pixels, console.notes());
  out.resolution = scene.resolution;
  out.frame_rate = scene.frame_rate;
  out.light = {*frame.number, frame.paths.input, scene.numbers, scene.statistics->sp_ratio(),
               running_effects(scene.plan)};
}

std::vector<Metered> meter_all(const ImageSettings& settings, const std::vector<Frame>& frames,
                               const FrameOptions& options, const Console& console) {
  std::vector<Metered> all(frames.size());
  ProgressLine line(console, "frames", static_cast<std::int64_t>(frames.size()), ProgressLine::Log::lines);
  SaidOnce said;
  const auto work = [&](std::size_t i) {
    const Console notes(console.options(), [&](const std::string& text) { all[i].notes.push_back(text); });
    try {
      meter_one(settings, frames[i], notes, all[i]);
    } catch (...) {
      all[i].failure = error_of(std::current_exception());
    }
  };
  in_order(frames.size(), options.at_once, work, [&](std::size_t i) {
    said.say(console, frames[i].paths, all[i].notes);
    line.at(static_cast<std::int64_t>(i + 1));
    return !all[i].failure || options.continue_on_error;
  });
  return all;
}

/// Where an eye stands at each frame that follows the frames' own adaptations.
std::vector<AdaptationTrace> traces_of(const std::vector<FrameLight>& frames, const ImageSettings& settings,
                                       double frame_rate) {
  std::vector<AdaptationKey> keys;
  for (const FrameLight& f : frames) keys.push_back({f.frame, f.numbers.adaptation});
  const AdaptationTrack track(keys, settings.time.history, frame_rate, keys.back().frame, "");
  std::vector<AdaptationTrace> out;
  for (const FrameLight& f : frames)
    out.push_back({track.state(f.frame), thresholds_of(track.state(f.frame), f.numbers.adaptation)});
  return out;
}

/// Whether the frame calls for time, by an eye that follows the frames before it.
void set_time(FrameLight& light, const AdaptationTrace& trace, const ImageSettings& settings) {
  std::erase(light.effects, "time");
  if (settings.time.history.empty() || !adaptation_is_called_for(trace.thresholds, light.numbers.adaptation))
    return;
  light.effects.emplace_back("time");
}

/// "; rods at 2.1 decades over their absolute threshold, cones at 3.0, 0.02 of what an adapted eye sees".
std::string trace_text(const AdaptationTrace& trace) {
  const AdaptationThresholds& t = trace.thresholds;
  return fmt::format("; threshold 10^{:.2f} of rods, 10^{:.2f} of cones, {:.3g} of what an adapted eye sees",
                     t.rod_log10, t.cone_log10, t.exposure);
}

void print(const std::vector<FrameLight>& frames, const std::vector<AdaptationTrace>& traces,
           const ShotAdaptation& shot, const std::vector<std::string>& effects,
           const std::vector<PlanChange>& changes) {
  constexpr int width = 30;
  const double span = std::log(shot.greatest / shot.least);
  fmt::print("   frame   La, cd/m2    S/P  {:<{}}  calls for\n", "", width);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameLight& f = frames[i];
    const bool adapting = std::find(f.effects.begin(), f.effects.end(), "time") != f.effects.end();
    const double share = span > 0 ? std::log(f.numbers.adaptation / shot.least) / span : 1;
    const auto bar = static_cast<std::size_t>(1 + std::lround(share * (width - 1)));
    fmt::print("{:>8} {:>11.4g} {:>6.3g}  {:<{}}  {}{}\n", f.frame, f.numbers.adaptation, f.sp_ratio,
               std::string(bar, '#'), width, effects_text(f.effects), adapting ? trace_text(traces[i]) : "");
  }
  for (const PlanChange& c : changes)
    fmt::print("from frame {} on: {}{}{}\n", c.frame, c.begins.empty() ? "" : "with " + joined(c.begins),
               c.begins.empty() || c.ends.empty() ? "" : ", ",
               c.ends.empty() ? "" : "without " + joined(c.ends));
  if (changes.empty()) fmt::print("all frames call for the same\n");
  fmt::print(
      "the shot, as --adaptation-from frames takes it: {:.4g} cd/m2 (median of {} frames, {:.4g} to {:.4g}): "
      "{}\n",
      shot.median, shot.frames, shot.least, shot.greatest, effects_text(effects));
}

void print_csv(const std::vector<FrameLight>& frames) {
  fmt::print("frame,adaptation_cdm2,sp_ratio,effects\n");
  for (const FrameLight& f : frames)
    fmt::print("{},{:g},{:g},{}\n", f.frame, f.numbers.adaptation, f.sp_ratio, fmt::join(f.effects, " "));
}

nlohmann::ordered_json result_of(const std::vector<FrameLight>& frames,
                                 const std::vector<AdaptationTrace>& traces, const ShotAdaptation& shot,
                                 const std::vector<std::string>& effects,
                                 const std::vector<PlanChange>& changes) {
  nlohmann::ordered_json out;
  out["shot"] = shot_json(shot);
  out["shot"]["effects"] = effects;
  out["changes"] = nlohmann::ordered_json::array();
  for (const PlanChange& c : changes)
    out["changes"].push_back({{"frame", c.frame}, {"begins", c.begins}, {"ends", c.ends}});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameLight& f = frames[i];
    out["frames"].push_back({{"frame", f.frame},
                             {"input", f.input},
                             {"adaptation", f.numbers.adaptation},
                             {"adaptationSource", f.numbers.adaptation_source},
                             {"whiteLuminance", f.numbers.white_luminance},
                             {"whiteLuminanceSource", f.numbers.white_luminance_source},
                             {"spRatio", f.sp_ratio},
                             {"state", adapting_json(traces[i].state, traces[i].thresholds)},
                             {"effects", f.effects}});
  }
  return out;
}

}  // namespace

std::vector<PlanChange> plan_changes(const std::vector<FrameLight>& frames) {
  const auto without = [](const std::vector<std::string>& a, const std::vector<std::string>& b) {
    std::vector<std::string> rest;
    for (const std::string& word : a)
      if (std::find(b.begin(), b.end(), word) == b.end()) rest.push_back(word);
    return rest;
  };
  std::vector<PlanChange> changes;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const std::vector<std::string>&before = frames[i - 1].effects, &now = frames[i].effects;
    if (before != now) changes.push_back({frames[i].frame, without(now, before), without(before, now)});
  }
  return changes;
}

int explain_frames(const ImageSettings& settings, const std::vector<Frame>& frames,
                   const FrameOptions& options, FramesTable table, const Console& console) {
  std::vector<FrameLight> lights;
  std::vector<double> adaptations;
  std::optional<Error> failure;
  std::optional<AngularResolution> resolution;
  double frame_rate = 24;
  for (Metered& m : meter_all(settings, frames, options, console)) {
    if (m.failure) {
      if (!options.continue_on_error) throw *m.failure;
      (void)report(*m.failure, console.json());
      if (!failure) failure = m.failure;
      continue;
    }
    if (!resolution) frame_rate = m.frame_rate;
    if (!resolution) resolution = m.resolution;
    adaptations.push_back(m.light.numbers.adaptation);
    lights.push_back(std::move(m.light));
  }
  if (lights.empty()) return static_cast<int>(failure->code());
  const std::vector<AdaptationTrace> traces = traces_of(lights, settings, frame_rate);
  for (std::size_t i = 0; i < lights.size(); ++i) set_time(lights[i], traces[i], settings);
  const ShotAdaptation shot = shot_adaptation(adaptations);
  SceneNumbers of_shot = lights.front().numbers;
  of_shot.adaptation = shot.median;
  // As apply has it, which then looks at no frame's statistics.
  const std::vector<std::string> effects = running_effects(plan_for(settings, of_shot, *resolution, nullptr));
  const std::vector<PlanChange> changes = plan_changes(lights);
  if (table == FramesTable::bars) print(lights, traces, shot, effects, changes);
  if (table == FramesTable::csv) print_csv(lights);
  console.result(result_of(lights, traces, shot, effects, changes));
  return static_cast<int>(failure ? failure->code() : ExitCode::done);
}

}  // namespace scotopic

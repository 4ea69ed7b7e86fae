#include "cli/sequence/shot_adaptation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "cli/sequence/in_order.h"
#include "cli/sequence/progress_line.h"
#include "pipeline/run.h"
#include "pipeline/scene/open_image.h"

namespace scotopic {
namespace {

/// One frame's own adaptation, and whether its unit came from the file.
struct FrameMeter {
  double adaptation = 0;
  std::optional<double> file_unit;
  std::optional<Error> failure;
};

constexpr std::string_view track_of = "track:";

FrameMeter meter_frame(const ImageSettings& settings, const Frame& frame) {
  FrameMeter out;
  try {
    ImageJob job;
    job.input = frame.paths.input;
    const SceneNumbers numbers = read_scene(job, settings, Statistics::where_needed, Notes()).numbers;
    out.adaptation = numbers.adaptation;
    out.file_unit = numbers.of_file ? std::optional(numbers.white_luminance) : std::nullopt;
  } catch (...) {
    out.failure = error_of(std::current_exception());
  }
  return out;
}

/// All frames' units, where files tell them, are used as they are; that they differ is said.
void compare_units(const std::vector<FrameMeter>& meters, const std::vector<Frame>& frames,
                   const Console& console) {
  std::optional<double> first;
  for (std::size_t i = 0; i < meters.size(); ++i) {
    if (!meters[i].file_unit) continue;
    if (!first) first = meters[i].file_unit;
    if (*meters[i].file_unit == *first) continue;
    console.note(
        fmt::format("{}: says that value 1 is {:.4g} cd/m2, earlier frames {:.4g}: each is taken at its word",
                    frames[i].paths.input, *meters[i].file_unit, *first));
    return;
  }
}

std::vector<FrameMeter> meter_frames(const ImageSettings& settings, const std::vector<Frame>& frames,
                                     const FrameOptions& options, const Console& console) {
  std::vector<FrameMeter> meters(frames.size());
  ProgressLine line(console, "frames metered", static_cast<std::int64_t>(frames.size()),
                    ProgressLine::Log::lines);
  in_order(
      frames.size(), options.at_once, [&](std::size_t i) { meters[i] = meter_frame(settings, frames[i]); },
      [&](std::size_t i) {
        line.at(static_cast<std::int64_t>(i + 1));
        return !meters[i].failure || options.continue_on_error;
      });
  for (const FrameMeter& m : meters)
    if (m.failure && !options.continue_on_error) throw *m.failure;
  compare_units(meters, frames, console);
  return meters;
}

std::string contents_of(const std::string& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error(ExitCode::input, file,
                "cannot be read: --adaptation-from takes frames, track, a file that explain --json wrote "
                "(track:FILE for "
                "each frame's own), or one of keys");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What explain --json says of a shot; nullopt: it says nothing of one.
std::optional<double> shot_adaptation_in(const std::string& text, const std::string& file) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("shot")) return std::nullopt;
  const auto number = json["shot"].is_object() && json["shot"].contains("adaptation")
                          ? json["shot"]["adaptation"]
                          : nlohmann::json();
  const double value = number.is_number() ? number.get<double>() : 0;
  if (!(value >= 1e-9 && value <= 1e9))
    throw Error(ExitCode::input, file, "has no adaptation of a shot, as explain --frames --json writes it");
  return value;
}

/// Adaptations of the frames that could be metered, in their order.
std::vector<AdaptationKey> metered_keys(const ImageSettings& settings, const std::vector<Frame>& frames,
                                        const FrameOptions& options, const Console& console) {
  std::vector<AdaptationKey> keys;
  std::optional<Error> failure;
  const std::vector<FrameMeter> meters = meter_frames(settings, frames, options, console);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (meters[i].failure)
      failure = failure ? failure : meters[i].failure;
    else
      keys.push_back({*frames[i].number, meters[i].adaptation});
  }
  if (keys.empty()) throw *failure;
  std::sort(keys.begin(), keys.end(),
            [](const AdaptationKey& a, const AdaptationKey& b) { return a.frame < b.frame; });
  return keys;
}

/// Of the first frame's file where --fps does not tell.
double frame_rate_of(const ImageSettings& settings, const Frame& first, const Console& console) {
  const StageValues& stages = settings.choice.stages;
  if (stages.number("fps") > 0) return stages.number("fps");
  const FrameRate found =
      frame_rate(stages, *open_input(first.paths.input, settings.spectral, settings.limits, console.notes()));
  console.note(fmt::format("{:g} frames a second ({}; --fps tells)", found.rate, found.source));
  return found.rate;
}

AdaptationTrack track_from(std::vector<AdaptationKey> keys, const ImageSettings& settings,
                           const std::vector<Frame>& frames, const std::string& source,
                           const Console& console) {
  int last = 0;
  for (const Frame& frame : frames) last = std::max(last, frame.number.value_or(0));
  return {std::move(keys), settings.time.history, frame_rate_of(settings, frames.front(), console), last,
          source};
}

}  // namespace

void add_adaptation_from_option(CLI::App& verb, std::string& adaptation_from) {
  verb.add_option(
          "--adaptation-from", adaptation_from,
          "One adaptation for all frames: frames (the median of theirs), or a file that explain --json wrote "
          "of "
          "them; or an eye that follows: track (each frame's own), track:FILE (explain's), or a file of keys "
          "(frame,cd/m2 lines, or JSON)")
      ->type_name("WHAT")
      ->group("What is seen");
}

void check_shot_adaptation(const std::string& adaptation_from, const OperatorChoice& choice,
                           const std::vector<Frame>& frames) {
  if (adaptation_from.empty()) return;
  if (choice.adaptation)
    throw Error(ExitCode::usage, "",
                "--adaptation-from meters the frames, --adaptation gives a number: choose one");
  if ((adaptation_from == "frames" || adaptation_from == "track") && !frames.front().number)
    throw Error(ExitCode::usage, "", "--adaptation-from " + adaptation_from + " needs --frames");
}

ShotAdaptation shot_adaptation(std::vector<double> a) {
  std::sort(a.begin(), a.end());
  const std::size_t n = a.size();
  const double median = n % 2 == 1 ? a[n / 2] : std::sqrt(a[n / 2 - 1]) * std::sqrt(a[n / 2]);
  return {median, a.front(), a.back(), n};
}

nlohmann::ordered_json shot_json(const ShotAdaptation& shot) {
  return {{"adaptation", shot.median},
          {"least", shot.least},
          {"greatest", shot.greatest},
          {"frames", shot.frames}};
}

std::optional<AdaptationTrack> resolve_shot_adaptation(const std::string& from, ImageSettings& settings,
                                                       const std::vector<Frame>& frames,
                                                       const FrameOptions& options, const Console& console) {
  OperatorChoice& choice = settings.choice;
  check_shot_adaptation(from, choice, frames);
  if (from.empty()) {
    if (frames.size() > 1 && !choice.adaptation)
      console.note(
          "each frame is adapted to its own light, which can flicker: --adaptation-from frames holds one for "
          "all");
    return std::nullopt;
  }
  if (from == "track")
    return track_from(metered_keys(settings, frames, options, console), settings, frames,
                      "track of the frames", console);
  if (from == "frames") {
    std::vector<double> adaptations;
    for (const AdaptationKey& key : metered_keys(settings, frames, options, console))
      adaptations.push_back(key.luminance);
    const ShotAdaptation shot = shot_adaptation(adaptations);
    choice.adaptation = shot.median;
    choice.adaptation_source =
        fmt::format("median of {} frames, {:.4g} to {:.4g}", shot.frames, shot.least, shot.greatest);
    return std::nullopt;
  }
  const bool track = from.rfind(track_of, 0) == 0;
  const std::string file = track ? from.substr(track_of.size()) : from;
  const std::string text = contents_of(file);
  if (const std::optional<double> shot = track ? std::nullopt : shot_adaptation_in(text, file)) {
    choice.adaptation = *shot;
    choice.adaptation_source = "the shot's, from " + file;
    return std::nullopt;
  }
  return track_from(parse_adaptation_keys(text, file), settings, frames, "track of " + file, console);
}

}  // namespace scotopic

#include "cli/sequence/shot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "cli/sequence/in_order.h"
#include "cli/sequence/progress_line.h"
#include "pipeline/run.h"

namespace scotopic {
namespace {

/// One frame's own adaptation, and whether its unit came from the file.
struct FrameMeter {
  double adaptation = 0;
  std::optional<double> file_unit;
  std::optional<Error> failure;
};

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
void compare_units(const std::vector<FrameMeter>& meters, const std::vector<Frame>& frames, const Console& console) {
  std::optional<double> first;
  for (std::size_t i = 0; i < meters.size(); ++i) {
    if (!meters[i].file_unit) continue;
    if (!first) first = meters[i].file_unit;
    if (*meters[i].file_unit == *first) continue;
    console.note(fmt::format("{}: says that value 1 is {:.4g} cd/m2, earlier frames {:.4g}: each is taken at its word",
                             frames[i].paths.input, *meters[i].file_unit, *first));
    return;
  }
}

std::vector<FrameMeter> meter_frames(const ImageSettings& settings, const std::vector<Frame>& frames,
                                     const FrameOptions& options, const Console& console) {
  std::vector<FrameMeter> meters(frames.size());
  ProgressLine line(console, "frames metered", static_cast<std::int64_t>(frames.size()), ProgressLine::Log::lines);
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

double read_shot(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(ExitCode::input, file, "cannot be read: --adaptation-from takes 'frames' or a file that explain --json wrote");
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  const auto number = json.is_object() && json.contains("shot") && json["shot"].is_object() && json["shot"].contains("adaptation")
                          ? json["shot"]["adaptation"]
                          : nlohmann::json();
  const double value = number.is_number() ? number.get<double>() : 0;
  if (!(value >= 1e-9 && value <= 1e9))
    throw Error(ExitCode::input, file, "has no adaptation of a shot, as explain --frames --json writes it");
  return value;
}

}  // namespace

void add_shot_options(CLI::App& verb, std::string& adaptation_from) {
  verb.add_option("--adaptation-from", adaptation_from,
                  "One adaptation for all frames: frames (the median of theirs), or a file that explain --json wrote of them")
      ->type_name("frames|FILE")
      ->group("What is seen");
}

void check_shot(const std::string& adaptation_from, const OperatorChoice& choice, const std::vector<Frame>& frames) {
  if (adaptation_from.empty()) return;
  if (choice.adaptation)
    throw Error(ExitCode::usage, "", "--adaptation-from meters the frames, --adaptation gives a number: choose one");
  if (adaptation_from == "frames" && !frames.front().number)
    throw Error(ExitCode::usage, "", "--adaptation-from frames needs --frames");
}

ShotLight shot_light(std::vector<double> a) {
  std::sort(a.begin(), a.end());
  const std::size_t n = a.size();
  const double median = n % 2 == 1 ? a[n / 2] : std::sqrt(a[n / 2 - 1]) * std::sqrt(a[n / 2]);
  return {median, a.front(), a.back(), n};
}

nlohmann::ordered_json shot_json(const ShotLight& shot) {
  return {{"adaptation", shot.median}, {"least", shot.least}, {"greatest", shot.greatest}, {"frames", shot.frames}};
}

void settle_shot(const std::string& adaptation_from, ImageSettings& settings, const std::vector<Frame>& frames,
                 const FrameOptions& options, const Console& console) {
  OperatorChoice& choice = settings.choice;
  check_shot(adaptation_from, choice, frames);
  if (adaptation_from.empty()) {
    if (frames.size() > 1 && !choice.adaptation)
      console.note("each frame is adapted to its own light, which can flicker: --adaptation-from frames holds one for all");
  } else if (adaptation_from != "frames") {
    choice.adaptation = read_shot(adaptation_from);
    choice.adaptation_source = "the shot's, from " + adaptation_from;
  } else {
    std::vector<double> adaptations;
    std::optional<Error> failure;
    for (const FrameMeter& m : meter_frames(settings, frames, options, console)) {
      if (m.failure) failure = failure ? failure : m.failure;
      else adaptations.push_back(m.adaptation);
    }
    if (adaptations.empty()) throw *failure;
    const ShotLight shot = shot_light(adaptations);
    choice.adaptation = shot.median;
    choice.adaptation_source =
        fmt::format("median of {} frames, {:.4g} to {:.4g}", shot.frames, shot.least, shot.greatest);
  }
}

}  // namespace scotopic

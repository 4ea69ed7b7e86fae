#include "cli/sequence/run_frames.h"

#include <fmt/format.h>

#include "cli/sequence/in_order.h"
#include "cli/sequence/progress_line.h"
#include "cli/sequence/provenance.h"
#include "io/frame_pattern.h"

namespace scotopic {
namespace {

/// What became of a frame.
struct Outcome {
  nlohmann::ordered_json result;
  bool skipped = false;
  std::optional<Error> failure;
  std::vector<std::string> notes;
};

/// Frames as jobs, and whether one is done already.
class FrameList {
 public:
  FrameList(const std::string& verb, FrameJob& work, const FrameOptions& options, bool stamped,
            const CommonOptions& common)
      : work_(work),
        skip_(options.skip_existing),
        stamped_(stamped || skip_),
        common_(stamped_ ? common_provenance(verb, work, common.typed) : "") {}

  ImageJob job(const Frame& frame) const {
    ImageJob out;
    out.input = frame.paths.input;
    out.output = frame.paths.output;
    out.moment.frame = frame.number.value_or(0);
    if (stamped_) out.provenance = provenance_of(common_, frame.paths);
    return out;
  }
  /// The output is what this job would make.
  bool is_made(const ImageJob& job) const {
    return skip_ && holds_provenance(job.output, job.provenance, work_.limits());
  }

 private:
  FrameJob& work_;
  bool skip_;
  bool stamped_;
  std::string common_;
};

nlohmann::ordered_json skipped_result(const ImageJob& job) {
  return {{"input", job.input}, {"output", job.output}};
}

int run_one(const FrameList& list, FrameJob& work, const Frame& frame, const Console& console) {
  std::optional<ProgressLine> line;
  ImageJob job = list.job(frame);
  job.progress = [&](std::int64_t done, std::int64_t total) {
    if (!line) line.emplace(console, "rows", total, ProgressLine::Log::lines);
    line->at(done);
  };
  const bool skipped = list.is_made(job);
  nlohmann::ordered_json result = skipped ? skipped_result(job) : work.run(job, console);
  line.reset();
  if (skipped) {
    console.note(job.output + ": is what this command made of this input; left as it is");
    result["skipped"] = true;
  }
  console.result(result);
  return static_cast<int>(ExitCode::done);
}

/// What is told while a sequence goes through, and at its end.
class SequenceReport {
 public:
  SequenceReport(const std::vector<Frame>& frames, const Console& console)
      : frames_(frames),
        console_(console),
        line_(console, "frames", static_cast<std::int64_t>(frames.size()), ProgressLine::Log::silent) {}

  void add(const Frame& frame, Outcome& outcome) {
    said_.say(console_, frame.paths, outcome.notes);
    nlohmann::ordered_json entry = {{"frame", *frame.number}};
    if (outcome.failure) {
      failed_.push_back(*frame.number);
      if (!first_failure_) first_failure_ = outcome.failure;
      (void)report(*outcome.failure, console_.json());
      entry.update({{"input", frame.paths.input},
                    {"output", frame.paths.output},
                    {"status", "failed"},
                    {"code", static_cast<int>(outcome.failure->code())},
                    {"message", outcome.failure->what()}});
    } else {
      ++(outcome.skipped ? skipped_ : written_);
      if (outcome.result.value("nonFinite", 0) > 0) non_finite_.push_back(*frame.number);
      entry["status"] = outcome.skipped ? "skipped" : "written";
      entry.update(outcome.result);
    }
    results_.push_back(std::move(entry));
    tell_progress(frame, outcome);
  }

  int finish() {
    if (console_.json())
      console_.result(
          {{"frames", results_}, {"written", written_}, {"skipped", skipped_}, {"failed", failed_.size()}});
    console_.note(summary());
    return static_cast<int>(first_failure_ ? first_failure_->code() : ExitCode::done);
  }

 private:
  void tell_progress(const Frame& frame, const Outcome& outcome) {
    line_.at(static_cast<std::int64_t>(results_.size()), static_cast<std::int64_t>(skipped_));
    if (on_terminal() || console_.json() || outcome.failure || !told()) return;
    console_.note(fmt::format("{}: {} ({})", frame.paths.output,
                              outcome.skipped ? "is there already" : "written", line_.text()));
  }

  /// Not each of many frames: some ten in all.
  bool told() const {
    const std::size_t every = console_.options().verbose ? 1 : (frames_.size() + 9) / 10;
    return results_.size() % every == 0;
  }

  std::string summary() const {
    std::string text = fmt::format("{} of {} frames written", written_, frames_.size());
    if (skipped_ > 0) text += fmt::format(", {} there already", skipped_);
    if (!failed_.empty()) text += fmt::format(", {} failed ({})", failed_.size(), frames_text(failed_));
    if (!non_finite_.empty())
      text += fmt::format(", {} with pixels that are not finite ({})", non_finite_.size(),
                          frames_text(non_finite_));
    const std::size_t left = frames_.size() - results_.size();
    if (left > 0)
      text += fmt::format(", {} not begun (from frame {} on)", left, *frames_[results_.size()].number);
    return text;
  }

  const std::vector<Frame>& frames_;
  const Console& console_;
  ProgressLine line_;
  SaidOnce said_;
  nlohmann::ordered_json results_ = nlohmann::ordered_json::array();
  std::size_t written_ = 0, skipped_ = 0;
  std::vector<int> failed_, non_finite_;
  std::optional<Error> first_failure_;
};

int run_sequence(const FrameList& list, FrameJob& work, const std::vector<Frame>& frames,
                 const FrameOptions& options, const Console& console) {
  std::vector<Outcome> outcomes(frames.size());
  SequenceReport report(frames, console);
  const auto make = [&](std::size_t i) {
    Outcome& outcome = outcomes[i];
    const Console notes(console.options(), [&](const std::string& line) { outcome.notes.push_back(line); });
    try {
      const ImageJob job = list.job(frames[i]);
      outcome.skipped = list.is_made(job);
      outcome.result = outcome.skipped ? skipped_result(job) : work.run(job, notes);
    } catch (...) {
      outcome.failure = error_of(std::current_exception());
    }
  };
  in_order(frames.size(), options.at_once, make, [&](std::size_t i) {
    report.add(frames[i], outcomes[i]);
    const bool more = !outcomes[i].failure || options.continue_on_error;
    outcomes[i] = Outcome();
    return more;
  });
  return report.finish();
}

/// A line whose numbers alone differ from frame to frame is the same line.
std::string without_numbers(const std::string& line) {
  std::string out;
  for (const char c : line)
    if (c < '0' || c > '9') out += c;
  return out;
}

}  // namespace

void SaidOnce::say(const Console& console, const FramePaths& paths, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const bool own = line.rfind(paths.input + ": ", 0) == 0;
    const std::string key = own ? line.substr(paths.input.size()) : line;
    if (said_.insert(console.options().verbose ? key : without_numbers(key)).second) console.note(line);
  }
}

int run_frames(const std::string& verb, FrameJob& job, const std::vector<Frame>& frames,
               const FrameOptions& options, const Console& console) {
  const bool sequence = frames.front().number.has_value();
  const FrameList list(verb, job, options, sequence, console.options());
  return sequence ? run_sequence(list, job, frames, options, console)
                  : run_one(list, job, frames.front(), console);
}

}  // namespace scotopic

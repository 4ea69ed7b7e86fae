#include "report/console.h"
#include "cli/sequence/frame_options.h"

#include <fmt/format.h>

#include <filesystem>
#include <unordered_map>

#include "cli/sequence/provenance.h"
#include "io/frame_pattern.h"
#include "io/atomic/output_file.h"
#include "options/values.h"

namespace scotopic {
namespace {

constexpr const char* group = "Sequences";

bool same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return std::filesystem::path(a).lexically_normal() == std::filesystem::path(b).lexically_normal() ||
         std::filesystem::equivalent(a, b, none);
}

/// A frame's result must not be another frame's source: which comes first would be chance.
void check_overlap(const std::vector<Frame>& frames) {
  std::unordered_map<std::string, int> number_of;
  for (const Frame& f : frames)
    number_of.emplace(std::filesystem::path(f.paths.input).lexically_normal().string(), *f.number);
  for (const Frame& f : frames) {
    const auto other = number_of.find(std::filesystem::path(f.paths.output).lexically_normal().string());
    if (other != number_of.end() && other->second != *f.number)
      throw Error(
          ExitCode::usage, f.paths.output,
          fmt::format("would be frame {}'s output and is frame {}'s input", *f.number, other->second));
  }
}

void check_inputs(const std::vector<Frame>& frames) {
  std::vector<int> missing;
  std::optional<Error> first;
  for (const Frame& frame : frames) {
    try {
      (void)input_files(frame.paths.input);
    } catch (const Error& error) {
      missing.push_back(frame.number.value_or(0));
      if (!first) first = error;
    }
  }
  if (!first) return;
  throw Error(
      first->code(), first->file(),
      fmt::format("{}: {} {}", first->what(), missing.size() > 1 ? "missing are frames" : "missing is frame",
                  frames_text(missing)));
}

void check_skipping(const std::vector<Frame>& frames) {
  const FramePaths& first = frames.front().paths;
  if (!first.output.empty() && same_file(first.input, first.output))
    throw Error(ExitCode::usage, first.output,
                "--skip-existing cannot tell what is done where the output replaces the input");
}

}  // namespace

void add_reading_frame_options(CLI::App& verb, FrameOptions& o) {
  verb.add_option("--frames", o.frames,
                  "1-240, 1-240x2, 1-10,20; names then hold the number's place: ####, @@@@ or %04d")
      ->type_name("LIST")
      ->group(group);
  verb.add_flag("--continue-on-error", o.continue_on_error,
                "Go on after a frame that fails; told of at the end")
      ->group(group);
  verb.add_option("--frames-at-once", o.at_once,
                  "Frames under way: one is read while another is computed or written")
      ->check(whole_number(1, 8))
      ->type_name("N")
      ->group(group)
      ->capture_default_str();
}

void add_frame_options(CLI::App& verb, FrameOptions& o) {
  add_reading_frame_options(verb, o);
  verb.add_flag("--skip-existing", o.skip_existing,
                "Leave outputs that this very command made of these very inputs; make the others anew")
      ->group(group);
}

namespace {

/// A pattern by itself is no file's name.
void refuse_pattern(const std::string& input) {
  if (input.find('#') == input.npos || std::filesystem::exists(input)) return;
  throw Error(ExitCode::input, input,
              "is no file; if it is a pattern of a sequence's names, --frames FIRST-LAST says which frames");
}

}  // namespace

std::vector<Frame> frames_of(const FrameOptions& o, const std::string& input, const std::string& output) {
  std::vector<Frame> frames;
  if (o.frames.empty()) {
    refuse_pattern(input);
    frames.push_back({std::nullopt, {input, output}});
  } else {
    const FramePattern in(input, "the input");
    const std::optional<FramePattern> out =
        output.empty() ? std::nullopt : std::optional<FramePattern>(std::in_place, output, "the output");
    for (const int number : parse_frames(o.frames))
      frames.push_back({number, {in.path(number), out ? out->path(number) : ""}});
    if (out) check_overlap(frames);
  }
  if (o.skip_existing) check_skipping(frames);
  return frames;
}

void check_places(const std::vector<Frame>& frames, const FrameOptions& o) {
  if (!frames.front().number) return;
  if (!o.continue_on_error) check_inputs(frames);
  if (!frames.front().paths.output.empty()) const OutputFile place(frames.front().paths.output);
}

}  // namespace scotopic

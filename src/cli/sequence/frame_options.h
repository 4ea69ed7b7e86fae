// Options of sequences: which frames, what to do about those that are there already, or that fail.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/sequence/frame_job.h"

namespace scotopic {

/// As typed.
struct FrameOptions {
  std::string frames;
  bool skip_existing = false;
  bool continue_on_error = false;
  int at_once = 2;
};

/// All of them, for verbs that write an image for each.
void add_frame_options(CLI::App& verb, FrameOptions& options);
/// Those that make sense where nothing is written: --frames, --continue-on-error, --frames-at-once.
void add_reading_frame_options(CLI::App& verb, FrameOptions& options);

/// One image of a command.
struct Frame {
  std::optional<int> number;  ///< in a sequence
  FramePaths paths;
};

/// Without --frames the one image, by its name as it is; with it every frame, by patterns. Error(usage) for a
/// name without a place for the number, for outputs that would overwrite another frame's input, and for
/// --skip-existing on a file that is its own input. `output` may be empty: then nothing is written.
std::vector<Frame> frames_of(const FrameOptions& options, const std::string& input,
                             const std::string& output);

/// Before anything is computed: Error(input) that names the frames whose input is missing (unless failures
/// are gone on after), and Error(output) where the folder of the first output cannot be written.
void check_places(const std::vector<Frame>& frames, const FrameOptions& options);

}  // namespace scotopic

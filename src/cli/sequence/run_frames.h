// A job on the images of a command: one, or a sequence in one process, read, computed and written in turns
// that overlap.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "cli/sequence/frame_job.h"
#include "cli/sequence/frame_options.h"

namespace scotopic {

/// Runs it, tells how far it is, and what it did; returns the exit code: of a sequence that of the first
/// frame, in its order, that failed. Notes that say the same of every frame are said once. A single image's
/// failure is thrown.
int run_frames(const std::string& verb, FrameJob& job, const std::vector<Frame>& frames,
               const FrameOptions& options, const Console& console);

/// Prints lines about frames, each once however many frames it is true of: a line that begins with a frame's
/// own input counts as the same for all, and so do lines whose numbers alone differ, unless all is asked for
/// (-v).
class SaidOnce {
 public:
  void say(const Console& console, const FramePaths& paths, const std::vector<std::string>& lines);

 private:
  std::unordered_set<std::string> said_;
};

}  // namespace scotopic

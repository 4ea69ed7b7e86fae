// explain on a sequence: the light of each frame, of the shot, and where what it calls for changes.
#pragma once

#include <string>
#include <vector>

#include "cli/sequence/frame_options.h"
#include "options/scene/scene_settings.h"

namespace scotopic {

/// What one frame calls for by itself.
struct FrameLight {
  int frame = 0;
  std::string input;
  SceneNumbers numbers;
  double sp_ratio = 0;
  std::vector<std::string> effects;  ///< that run
};

/// A frame whose effects are not those of the frame before.
struct PlanChange {
  int frame = 0;
  std::vector<std::string> begins, ends;
};
std::vector<PlanChange> plan_changes(const std::vector<FrameLight>& frames);

/// What is printed: a table with bars and the changes, a row of comma-separated values a frame, or --json
/// alone.
enum class FramesTable { bars, csv, none };

/// Meters every frame and prints what it found; returns the exit code.
int explain_frames(const ImageSettings& settings, const std::vector<Frame>& frames,
                   const FrameOptions& options, FramesTable table, const Console& console);

}  // namespace scotopic

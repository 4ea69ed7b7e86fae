// explain on a sequence: the light of each frame, of the shot, and where what it calls for changes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/sequence/frame_options.h"
#include "cli/scene/scene_settings.h"
#include "io/atomic/output_file.h"

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

/// Meters every frame, prints a table with bars and the changes (or --json), draws the plot if there is one; returns the
/// exit code.
int explain_frames(const ImageSettings& settings, const std::vector<Frame>& frames, const FrameOptions& options,
                   std::optional<OutputFile>& plot, const Console& console);

/// Adaptation luminance over frames, logarithmic, with the mesopic range, the shot's median and the changes: SVG 1.1.
std::string adaptation_svg(const std::vector<FrameLight>& frames, double shot, const std::vector<PlanChange>& changes);

/// Writes a text and puts the file in place.
void write_text(OutputFile& file, const std::string& text);

}  // namespace scotopic

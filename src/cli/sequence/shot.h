// One adaptation for a whole shot, so that nothing flickers from frame to frame.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/sequence/frame_options.h"
#include "cli/scene/scene_settings.h"

namespace scotopic {

/// Adds --adaptation-from to the operator's options.
void add_shot_options(CLI::App& verb, std::string& adaptation_from);

/// Error(usage) for --adaptation-from beside a number in --adaptation, or "frames" without --frames.
void check_shot(const std::string& adaptation_from, const OperatorChoice& choice, const std::vector<Frame>& frames);

/// The adaptation luminances of a shot's frames, cd/m2.
struct ShotLight {
  double median = 0, least = 0, greatest = 0;
  std::size_t frames = 0;
};
/// Of an even number of frames the median is the geometric mean of the middle two. At least one frame.
ShotLight shot_light(std::vector<double> adaptations);

/// What explain --json says of it, and apply --adaptation-from FILE reads.
nlohmann::ordered_json shot_json(const ShotLight& shot);

/// Sets the adaptation of `settings` where --adaptation-from asks for it: the median of all frames' own, each metered as
/// --adaptation says ("frames"), or the one that explain found ("FILE", its --json). For `frames` the unit has to
/// be known: Error(usage) names a frame that does not tell it. Without --adaptation-from, and where each frame would be
/// metered by itself, warns that the result may flicker.
void settle_shot(const std::string& adaptation_from, ImageSettings& settings, const std::vector<Frame>& frames,
                 const FrameOptions& options, const Console& console);

}  // namespace scotopic

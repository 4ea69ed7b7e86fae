// One adaptation for a whole shot, so that nothing flickers from frame to frame.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/sequence/adaptation_track.h"
#include "cli/sequence/frame_options.h"
#include "options/scene/scene_settings.h"

namespace scotopic {

/// Adds --adaptation-from to the operator's options.
void add_adaptation_from_option(CLI::App& verb, std::string& adaptation_from);

/// Error(usage) for --adaptation-from beside a number in --adaptation, or "frames" without --frames.
void check_shot_adaptation(const std::string& adaptation_from, const OperatorChoice& choice,
                           const std::vector<Frame>& frames);

/// The adaptation luminances of a shot's frames, cd/m2.
struct ShotAdaptation {
  double median = 0, least = 0, greatest = 0;
  std::size_t frames = 0;
};
/// Of an even number of frames the median is the geometric mean of the middle two. At least one frame.
ShotAdaptation shot_adaptation(std::vector<double> adaptations);

/// What explain --json says of it, and apply --adaptation-from FILE reads.
nlohmann::ordered_json shot_json(const ShotAdaptation& shot);

/// What --adaptation-from asks for. One adaptation for all frames is set in `settings`: the median of all
/// frames' own, each metered as --adaptation says ("frames"), or the one that explain found (FILE, its
/// --json). A track is returned: each frame's own ("track"), that which explain found ("track:FILE"), or keys
/// (FILE, parse_adaptation_keys). For `frames` and `track` the unit has to be known: Error(usage) names a
/// frame that does not tell it. Without
/// --adaptation-from, and where each frame would be metered by itself, warns that the result may flicker.
std::optional<AdaptationTrack> resolve_shot_adaptation(const std::string& adaptation_from,
                                                       ImageSettings& settings,
                                                       const std::vector<Frame>& frames,
                                                       const FrameOptions& options, const Console& console);

}  // namespace scotopic

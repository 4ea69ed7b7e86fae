// An adaptation luminance for each frame of a shot, and the state of an eye that follows it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adaptation/time/dark_adaptation.h"
#include "pipeline/run.h"

namespace scotopic {

/// What the eye is adapted to at a frame: cd/m2.
struct AdaptationKey {
  int frame;
  double luminance;

  bool operator==(const AdaptationKey&) const = default;
};

/// From text: CSV lines "frame,luminance" (a heading and lines that begin with # are left out), JSON (a list
/// of {"frame", "adaptation"}, or an object with such a list as "keys" or "frames": explain --json).
/// Error(input) names `file` and the place that is not understood; frames have to ascend.
std::vector<AdaptationKey> parse_adaptation_keys(const std::string& text, const std::string& file);

/// Between keys the logarithm of luminance is linear in time, outside it is held. The state at frame n is
/// reached from the first key by a step a frame: the same bits for any part of the shot.
class AdaptationTrack {
 public:
  /// At least one key, for frames up to `last`. `history`: light before the first key; empty: ever in its
  /// own.
  AdaptationTrack(std::vector<AdaptationKey> keys, std::span<const AdaptationPeriod> history,
                  double frame_rate, int last, std::string source);

  double luminance(double frame) const;
  /// Of a frame before the first key: as there.
  const AdaptationState& state(int frame) const;
  /// For run_image().
  TrackedAdaptation at(int frame) const;
  /// All that frames depend on, as text.
  std::string identity() const;

 private:
  std::vector<AdaptationKey> keys_;
  std::vector<AdaptationState> states_;  // from the first key's frame on
  double frame_rate_;
  std::string source_;
};

}  // namespace scotopic

// Adaptation in time: how far an eye that was in other light has come, and what it cannot see yet. One state
// beside the frames of a shot; no images.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scotopic {

/// What past light has left behind.
struct AdaptationState {
  double rod_bleached = 0;   ///< B_r, share of rhodopsin that is bleached
  double rod_product = 0;    ///< C_r, share of a slow product of its bleaching
  double cone_bleached = 0;  ///< B_c
  double rod_neural = 0;     ///< A_r, cd/m2: the luminance that rods' nerves have got used to
  double cone_neural = 0;    ///< A_c, cd/m2

  bool operator==(const AdaptationState&) const = default;
};

/// After `luminance` cd/m2 (>= 0) for ever.
AdaptationState adapted_state(double luminance) noexcept;

/// After `seconds` (>= 0) more of `luminance` cd/m2 (>= 0). Exact for constant luminance: what 14 400 steps
/// of 1/24 s reach is what one of 600 s does, to 1e-9 (tests/adaptation). adapted_state(luminance) stays as
/// it is, to the bit.
AdaptationState state_after(const AdaptationState& state, double luminance, double seconds) noexcept;

/// What an eye in this state sees where the scene's own adaptation luminance is La.
struct AdaptationThresholds {
  double rod_luminance;  ///< L_r, cd/m2: an eye adapted to it would have rods as insensitive; La once adapted
  double cone_luminance;  ///< L_c, likewise
  double rod_log10;       ///< log10 of the rods' threshold over the absolute one
  double cone_log10;      ///< of the cones'
  double log10;           ///< the lower of the two
  double exposure;        ///< e = min(100, adapted eye's threshold / this eye's); exactly 1 once adapted
};

/// Only bleaching beyond what La itself keeps up counts. Good to 0.3 decades and 2 minutes of measured
/// curves, which is as far as the sources agree (docs/model.md).
AdaptationThresholds thresholds_of(const AdaptationState& state, double luminance) noexcept;

/// Whether anything that the state drives is more than 1 % off what an adapted eye has.
bool adaptation_is_called_for(const AdaptationThresholds& thresholds, double luminance) noexcept;

/// So long in so much light.
struct AdaptationPeriod {
  double luminance;  ///< cd/m2
  double seconds;

  bool operator==(const AdaptationPeriod&) const = default;
};

/// Periods, or what is wrong with the text.
struct AdaptationHistory {
  std::vector<AdaptationPeriod> periods;
  std::string problem;  ///< empty: none
};

/// "La:seconds,..." in the order lived through; La a number >= 0 or a name of the ladder ("moon"), seconds >=
/// 0. Commas or line ends divide; blanks and what follows a # are left out. A text without any period is a
/// problem.
AdaptationHistory parse_adaptation_history(std::string_view text);

/// After the periods, and darkness before them. No periods: darkness.
AdaptationState state_after(std::span<const AdaptationPeriod> history) noexcept;

/// States at the frames 0, 1, ... of a shot, `frame_rate` a second, whose adaptation luminances are given
/// (cd/m2): at frame 0 `first`; from each to the next the eye is in the mean of the two. To begin elsewhere
/// in a shot, begin at frame 0: one scalar step a frame, and the very same bits.
std::vector<AdaptationState> track_states(const AdaptationState& first, std::span<const double> luminances,
                                          double frame_rate);

}  // namespace scotopic

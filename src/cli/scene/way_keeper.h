// The way in which pixels are computed, kept from frame to frame.
#pragma once

#include <mutex>
#include <optional>

#include "cli/scene/precision_options.h"

namespace scotopic {

/// Prepares a way once for frames of the same scene parameters: a LUT is baked once. What --max-error or --budget picked
/// for the first frame is used for all, so that timings cannot make frames differ. Any number of threads.
class WayKeeper {
 public:
  explicit WayKeeper(const PrecisionChoice& choice) : choice_(choice) {}

  /// As settle() has it.
  ChosenWay way(const AppearanceParameters& parameters, bool receptors, const Console& console);

 private:
  std::mutex lock_;
  PrecisionChoice choice_;
  std::optional<ChosenWay> kept_;
  AppearanceParameters parameters_;
  bool receptors_ = false;
};

}  // namespace scotopic

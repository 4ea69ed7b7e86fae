// Which effects a scene calls for, and why: a pure function of what was measured and what was asked.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stages/shared/parameters.h"
#include "scene/scene_statistics.h"

namespace scotopic {

/// Luminances that differ by this share are .05 dE00 apart at mid-grey (dL*/L = 38.7 Y^1/3 at Y = .184: 22
/// per unit). Mesopic luminance is skipped only where no pixel's S/P ratio is further from white's: at 5 %,
/// as sometimes proposed, skipping can be seen (.65 dE00 for a bluish grey; tests/scene).
inline constexpr double sp_tolerance = 0.002;

/// Whether one effect runs, and why.
struct EffectDecision {
  std::string_view effect;  ///< the stage's name
  bool asked = false;
  bool left_out = false;  ///< would be asked for, were pixels per degree known
  bool needed = false;    ///< the scene calls for it
  double number = 0;      ///< what decided, in `unit`
  double threshold = 0;
  std::string_view unit{};
  std::string reason{};   ///< one sentence holding number and threshold
  double share = 0;       ///< of pixels that it would touch, 0 to 1
  double difference = 0;  ///< largest dE00, exposed to mid-grey, it makes over the samples

  /// It was asked for, and the scene calls for it.
  bool runs() const noexcept { return asked && needed; }
};

/// The decisions, and what to compute.
struct ScenePlan {
  std::vector<EffectDecision> effects;
  AppearanceParameters parameters;  ///< of the run: effects that are not needed are off

  /// The decision about an effect; throws std::out_of_range for a name that is none.
  const EffectDecision& effect(std::string_view name) const;
  /// Nothing to compute: the picture is returned as it came.
  bool nothing() const noexcept;
};

/// Decides about the pixel stages; the others decide for themselves (pipeline/stages). Without statistics the
/// decision rests on La alone, and pixels are skipped one by one where they are. Skipping shift, luminance
/// and chroma as planned changes no bit where all of Lloc >= 5 cd/m2; skipping mesopic luminance alone (S/P
/// within sp_tolerance) changes a colour by at most .05 dE00. `asked`: La and unit of the scene; strengths as
/// asked, 0 = switched off by the user.
ScenePlan plan_scene(const AppearanceParameters& asked, const SceneStatistics* statistics);

}  // namespace scotopic

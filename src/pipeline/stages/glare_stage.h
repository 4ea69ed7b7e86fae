// Stage glare on whole pictures: what of a scene scatters in the eye.
#pragma once

#include <memory>

#include "pipeline/settings.h"

namespace scotopic {

/// `wish`: whether --effects asks for it. `shown` tells what a display cannot show: the threshold, unless one
/// is chosen.
std::shared_ptr<const FrameStage> glare_stage(const GlareChoice& choice, EffectWish wish,
                                              const NightDisplayParameters& shown);

}  // namespace scotopic

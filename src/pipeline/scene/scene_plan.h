// The plan of an image: what is asked, what the scene calls for, and how that is said.
#pragma once

#include <string>
#include <vector>

#include "pipeline/settings.h"
#include "scene/plan.h"

namespace scotopic {

/// With --effects auto what the scene calls for (statistics may be nullptr); else all that is asked for. In
/// the table's order; `decided`: what stages other than the pixel stages have decided for themselves.
ScenePlan plan_of(const OperatorChoice& choice, const AppearanceParameters& scene,
                  const SceneStatistics* statistics, const std::vector<EffectDecision>& decided);

/// "shift, chroma; skipped luminance (no pixel's S/P ...), detail (...)".
std::string plan_line(const ScenePlan& plan);

}  // namespace scotopic

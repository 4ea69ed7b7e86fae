// The plan of an image: what is asked, what the scene calls for, and how that is said.
#pragma once

#include <string>

#include "pipeline/scene/angular_resolution.h"
#include "pipeline/settings.h"
#include "scene/plan.h"

namespace scotopic {

/// What is asked for in a scene. Acuity is asked for by --acuity, by its name in --effects, or, with auto and
/// all, by telling how many pixels a degree has.
PlanRequest plan_request(const OperatorChoice& choice, const AppearanceParameters& scene,
                         const AcuityChoice& acuity, const AngularResolution& resolution);

/// With --effects auto what the scene calls for (statistics may be nullptr); else all that is asked for.
ScenePlan plan_of(const OperatorChoice& choice, const PlanRequest& request,
                  const SceneStatistics* statistics);

/// Puts a decision that was taken elsewhere in its place.
void set_decision(ScenePlan& plan, const EffectDecision& decision);

/// "shift, chroma; skipped luminance (no pixel's S/P ...), acuity (...)".
std::string plan_line(const ScenePlan& plan);

}  // namespace scotopic

// The plan on the command line: what is asked, what the scene calls for, and how that is said.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/options/acuity_options.h"
#include "cli/options/operator_options.h"
#include "scene/plan.h"

namespace scotopic {

/// What the options ask for. Acuity is asked for by --acuity, by its name in --effects, or, with auto and all, by
/// telling how many pixels a degree has.
PlanRequest plan_request(const OperatorChoice& choice, const AcuityChoice& acuity, const AngularResolution& resolution);

/// With --effects auto what the scene calls for (statistics may be nullptr); else all that is asked for.
ScenePlan plan_of(const OperatorChoice& choice, const PlanRequest& request, const SceneStatistics* statistics);

/// "shift, chroma; skipped luminance (no pixel's S/P ...), acuity (...)".
/// Puts a decision taken elsewhere in its place.
void replace_decision(ScenePlan& plan, const EffectDecision& decision);

std::string plan_line(const ScenePlan& plan);

nlohmann::ordered_json plan_json(const ScenePlan& plan);

}  // namespace scotopic

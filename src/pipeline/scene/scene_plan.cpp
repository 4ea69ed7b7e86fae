#include "pipeline/scene/scene_plan.h"

#include <algorithm>

namespace scotopic {

PlanRequest plan_request(const OperatorChoice& choice, const AppearanceParameters& scene,
                         const AcuityChoice& acuity, const AngularResolution& resolution) {
  PlanRequest request;
  request.parameters = scene;
  request.acuity = acuity.asked || choice.acuity == EffectWish::yes ||
                   (choice.acuity == EffectWish::if_known && resolution.known);
  if (acuity.parameters.strength * scene.strength.all == 0) request.acuity = false;
  if (resolution.known || request.acuity) request.pixels_per_degree = resolution.pixels_per_degree;
  return request;
}

ScenePlan plan_of(const OperatorChoice& choice, const PlanRequest& request,
                  const SceneStatistics* statistics) {
  ScenePlan plan = plan_scene(request, statistics);
  if (choice.plan_effects) return plan;
  plan.parameters = request.parameters;
  plan.acuity = request.acuity;
  for (EffectDecision& d : plan.effects)
    if (d.asked && !d.needed) {
      d.needed = true;
      d.reason += "; applied all the same: --effects says so";
    }
  return plan;
}

void set_decision(ScenePlan& plan, const EffectDecision& decision) {
  const auto same = [&](const EffectDecision& d) { return d.effect == decision.effect; };
  const auto found = std::find_if(plan.effects.begin(), plan.effects.end(), same);
  if (found != plan.effects.end())
    *found = decision;
  else
    plan.effects.push_back(decision);
}

std::string plan_line(const ScenePlan& plan) {
  std::string runs, skipped;
  for (const EffectDecision& d : plan.effects) {
    if (!d.simulated || !d.asked) continue;
    if (d.runs())
      runs += (runs.empty() ? "" : ", ") + std::string(d.effect);
    else
      skipped += (skipped.empty() ? "" : ", ") + std::string(d.effect) + " (" + d.reason + ")";
  }
  if (runs.empty()) runs = "nothing to do";
  return skipped.empty() ? runs : runs + "; skipped " + skipped;
}

}  // namespace scotopic

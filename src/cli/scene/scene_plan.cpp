#include "cli/scene/scene_plan.h"

namespace scotopic {

PlanRequest plan_request(const OperatorChoice& choice, const AcuityChoice& acuity, const AngularResolution& resolution) {
  PlanRequest request;
  request.parameters = choice.parameters;
  request.acuity = acuity.asked || choice.acuity == EffectWish::yes ||
                   (choice.acuity == EffectWish::if_known && resolution.known);
  if (acuity.parameters.strength * choice.parameters.strength.all == 0) request.acuity = false;
  if (resolution.known || request.acuity) request.pixels_per_degree = resolution.pixels_per_degree;
  return request;
}

ScenePlan plan_of(const OperatorChoice& choice, const PlanRequest& request, const SceneStatistics* statistics) {
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

void replace_decision(ScenePlan& plan, const EffectDecision& decision) {
  for (EffectDecision& d : plan.effects)
    if (d.effect == decision.effect) d = decision;
}

std::string plan_line(const ScenePlan& plan) {
  std::string runs, skipped;
  for (const EffectDecision& d : plan.effects) {
    if (!d.simulated || !d.asked) continue;
    if (d.runs()) runs += (runs.empty() ? "" : ", ") + std::string(d.effect);
    else skipped += (skipped.empty() ? "" : ", ") + std::string(d.effect) + " (" + d.reason + ")";
  }
  if (runs.empty()) runs = "nothing to do";
  return skipped.empty() ? runs : runs + "; skipped " + skipped;
}

nlohmann::ordered_json plan_json(const ScenePlan& plan) {
  nlohmann::ordered_json out;
  for (const EffectDecision& e : plan.effects)
    out[std::string(e.effect)] = {{"simulated", e.simulated}, {"asked", e.asked},         {"needed", e.needed},
                                  {"runs", e.runs()},         {"number", e.number},       {"threshold", e.threshold},
                                  {"unit", e.unit},           {"share", e.share},         {"largestDifference", e.difference},
                                  {"reason", e.reason}};
  return out;
}

}  // namespace scotopic

#include "pipeline/scene/scene_plan.h"

#include <algorithm>

#include "base/names.h"

namespace scotopic {

namespace {

/// What is asked for runs, whatever the scene calls for; a frame stage looks at the subimage first.
void insist(EffectDecision& d) {
  if (!d.asked || d.needed) return;
  d.needed = true;
  d.reason += "; applied all the same: --effects says so";
}

}  // namespace

ScenePlan plan_of(const OperatorChoice& choice, const AppearanceParameters& scene,
                  const SceneStatistics* statistics, const std::vector<EffectDecision>& decided) {
  ScenePlan plan = plan_scene(scene, statistics);
  std::vector<EffectDecision> all = plan.effects;
  all.insert(all.end(), decided.begin(), decided.end());
  plan.effects.clear();
  const StageTable table = choice.stages.table();
  for (const StageEntry& entry : table)
    for (const EffectDecision& d : all)
      if (d.effect == entry.description->name) plan.effects.push_back(d);
  for (const EffectDecision& d : all)
    if (place_of(table, d.effect) == table.size()) plan.effects.push_back(d);
  if (choice.plan_effects) return plan;
  plan.parameters = scene;
  for (EffectDecision& d : plan.effects) {
    const std::size_t place = place_of(table, d.effect);
    if (place == table.size() || table[place].description->support != StageSupport::frame) insist(d);
  }
  return plan;
}

std::string plan_line(const ScenePlan& plan) {
  std::string runs, skipped, left_out, why;
  for (const EffectDecision& d : plan.effects) {
    if (d.runs()) add_to_list(runs, d.effect);
    if (d.asked && !d.needed) add_to_list(skipped, std::string(d.effect) + " (" + d.reason + ")");
    if (!d.left_out) continue;
    add_to_list(left_out, d.effect);
    why = d.reason;
  }
  std::string line = runs.empty() ? "nothing to do" : runs;
  if (!skipped.empty()) line += "; skipped " + skipped;
  if (!left_out.empty()) line += "; left out " + left_out + " (" + why + ")";
  return line;
}

}  // namespace scotopic

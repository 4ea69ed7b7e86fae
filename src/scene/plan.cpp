#include "scene/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "stages/shared/colour_difference.h"
#include "stages/reference.h"
#include "stages/limits.h"

namespace scotopic {
namespace {

std::string text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

// What all pixel-local effects share: they end where the local adaptation luminance reaches 5 cd/m2.
struct Darkness {
  double least_local;  // cd/m2
  double share;        // of pixels below the limit
  bool from_pixels;
};

Darkness darkness(const AppearanceParameters& p, const SceneStatistics* s) {
  const bool local = p.weight == Weight::local && s && s->finite() > 0;
  const double least =
      local ? p.adaptation + std::max(0.0, double{s->least} * p.white_luminance) : p.adaptation;
  if (!(least < photopic_limit)) return {least, 0, local};
  const double limit = (photopic_limit - p.adaptation) / p.white_luminance;
  return {least, local ? 1 - s->photopic.share_from(limit) : 1, local};
}

EffectDecision decide_dark(std::string_view effect, double strength, const Darkness& dark) {
  EffectDecision d{.effect = effect,
                   .asked = strength > 0,
                   .number = dark.least_local,
                   .threshold = photopic_limit,
                   .unit = "cd/m2"};
  d.needed = dark.least_local < photopic_limit;
  d.share = d.needed ? dark.share : 0;
  const char* what = dark.from_pixels ? "the darkest pixel is adapted to" : "the eye is adapted to";
  d.reason =
      what + text(d.needed ? " %.4g cd/m2, below %g" : " %.4g cd/m2, not below %g", d.number, d.threshold);
  return d;
}

EffectDecision decide_luminance(const AppearanceParameters& p, const Darkness& dark,
                                const SceneStatistics* s) {
  const double strength = p.luminance == LuminancePolicy::none ? 0 : p.strength.all * p.strength.luminance;
  EffectDecision d = decide_dark("luminance", strength, dark);
  if (!d.needed || !s || p.luminance != LuminancePolicy::mesopic || s->sp_deviation > sp_tolerance) return d;
  d.needed = false;
  d.share = 0;
  d.number = s->sp_deviation;
  d.threshold = sp_tolerance;
  d.unit = "";
  d.reason =
      text("no pixel's S/P ratio differs from white's by more than %.2g, within %g", d.number, d.threshold);
  return d;
}

// The thesis' pipeline has one stage, and no luminance from which on it ends.
void decide_safko(ScenePlan& plan) {
  for (EffectDecision& d : plan.effects) {
    if (d.effect == "luminance" || d.effect == "chroma") d.asked = false;
    if (d.effect != "shift") continue;
    d.needed = true;
    d.share = 1;
    d.reason = "safko2019 acts at every luminance";
  }
}

// Largest dE00 between results with and without the effect, over the samples.
double largest_difference(const AppearanceParameters& with, const AppearanceParameters& without,
                          const SceneStatistics& s) {
  const AppearanceReference a(with), b(without);
  double largest = 0;
  for (std::size_t i = 0; i + 2 < s.samples.size(); i += 3) {
    const ReferencePixel pixel{{s.samples[i], s.samples[i + 1], s.samples[i + 2]}, {}, {}};
    largest =
        std::max(largest, exposed_difference(with.xyz_from_rgb * a(pixel), with.xyz_from_rgb * b(pixel)));
  }
  return largest;
}

void measure_differences(ScenePlan& plan, const AppearanceParameters& asked, const SceneStatistics& s) {
  for (EffectDecision& d : plan.effects) {
    AppearanceParameters without = asked;
    if (d.effect == "shift")
      without.strength.shift = 0;
    else if (d.effect == "luminance")
      without.luminance = LuminancePolicy::photopic;
    else if (d.effect == "chroma")
      without.strength.chroma = 0;
    else
      continue;
    d.difference = largest_difference(asked, without, s);
  }
}

}  // namespace

const EffectDecision& ScenePlan::effect(std::string_view name) const {
  for (const EffectDecision& d : effects)
    if (d.effect == name) return d;
  throw std::out_of_range("no effect of this name");
}

bool ScenePlan::nothing() const noexcept {
  return std::none_of(effects.begin(), effects.end(), [](const EffectDecision& d) { return d.runs(); });
}

ScenePlan plan_scene(const AppearanceParameters& p, const SceneStatistics* statistics) {
  const Darkness dark = darkness(p, statistics);
  ScenePlan plan;
  plan.parameters = p;
  plan.effects = {decide_dark("shift", p.strength.all * p.strength.shift, dark),
                  decide_luminance(p, dark, statistics),
                  decide_dark("chroma", p.strength.all * p.strength.chroma, dark)};
  if (p.model == Model::safko2019) {
    decide_safko(plan);
    return plan;
  }
  if (statistics) measure_differences(plan, p, *statistics);
  if (!plan.effect("shift").needed) plan.parameters.strength.shift = 0;
  if (!plan.effect("chroma").needed) plan.parameters.strength.chroma = 0;
  // Where mesopic luminance equals photopic, the shift's own brightening still has to be undone.
  if (!plan.effect("luminance").needed && p.luminance == LuminancePolicy::mesopic)
    plan.parameters.luminance =
        plan.effect("shift").runs() ? LuminancePolicy::photopic : LuminancePolicy::none;
  return plan;
}

}  // namespace scotopic

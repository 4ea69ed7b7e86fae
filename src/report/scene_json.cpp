#include "report/scene_json.h"

#include "adaptation/mesopic.h"
#include "report/explain_report.h"
#include "report/image_report.h"

namespace scotopic {

LightNumbers light_of(const SceneStatistics& s, const SceneNumbers& numbers) {
  const double unit = numbers.white_luminance;
  const double sp = s.sp_ratio();
  const double m = mesopic_coefficient(numbers.adaptation, sp);
  return {unit * s.log_mean_luminance(),
          unit * s.mean_photopic(),
          unit * static_cast<double>(s.least),
          unit * static_cast<double>(s.greatest),
          unit * s.mean_scotopic(),
          sp,
          m,
          mesopic_luminance(unit * s.mean_photopic(), unit * s.mean_scotopic(), m)};
}

nlohmann::ordered_json explain_json(const std::string& input, const LightNumbers& light,
                                    const SceneReport& scene, const std::vector<double>& costs) {
  const SceneNumbers& numbers = scene.numbers;
  const SceneStatistics& statistics = *scene.statistics;
  const ScenePlan& plan = scene.plan;
  nlohmann::ordered_json out;
  out["input"] = input;
  out["adaptation"] = numbers.adaptation;
  out["adaptationSource"] = numbers.adaptation_source;
  out["whiteLuminance"] = numbers.white_luminance;
  out["whiteLuminanceSource"] = numbers.white_luminance_source;
  out["photopic"] = {{"logAverage", light.log_average},
                     {"mean", light.mean},
                     {"least", light.least},
                     {"greatest", light.greatest}};
  out["scotopic"] = {{"mean", light.scotopic_mean}};
  out["spRatio"] = light.sp_ratio;
  out["mesopicCoefficient"] = light.m;
  out["nonFinite"] = statistics.non_finite;
  out["spectral"] = spectral_json(scene.spectral);
  out["mesopic"] = {{"mean", light.mesopic}};
  out["effects"] = plan_json(plan);
  if (scene.adapting) out["state"] = adapting_json(scene.adapting->state, scene.adapting->thresholds);
  for (std::size_t i = 0; i < plan.effects.size(); ++i)
    out["effects"][std::string(plan.effects[i].effect)]["nsPerPixel"] = costs[i];
  for (const LuminanceBar& bar : luminance_bars(statistics, numbers.white_luminance))
    out["histogram"].push_back({{"from", bar.from}, {"to", 2 * bar.from}, {"share", bar.share}});
  out["darkShare"] = dark_share(statistics);
  out["advice"] = unit_advice(statistics, numbers.adaptation, numbers.white_luminance);
  return out;
}

nlohmann::ordered_json explain_json(const std::string& input, const SceneReport& scene) {
  return explain_json(input, light_of(*scene.statistics, scene.numbers), scene,
                      measure_costs(scene.asked, scene.plan, *scene.statistics));
}

}  // namespace scotopic

// What explain finds in the light of a scene, as numbers and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/run.h"

namespace scotopic {

/// Luminances in cd/m2.
struct LightNumbers {
  double log_average, mean, least, greatest;
  double scotopic_mean;
  double sp_ratio;
  double m;        ///< mesopic adaptation coefficient at La, of this light
  double mesopic;  ///< luminance that MES2 gives the mean light at that m
};

LightNumbers light_of(const SceneStatistics& statistics, const SceneNumbers& numbers);

/// `scene` with statistics; `costs` as measure_costs() has them.
nlohmann::ordered_json explain_json(const std::string& input, const LightNumbers& light,
                                    const SceneReport& scene, const std::vector<double>& costs);
/// The same, worked out and measured here.
nlohmann::ordered_json explain_json(const std::string& input, const SceneReport& scene);

}  // namespace scotopic

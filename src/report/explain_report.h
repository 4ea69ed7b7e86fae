// What explain prints: the light as bars, the effects as a table.
#pragma once

#include <string>
#include <vector>

#include "scene/plan.h"
#include "scene/scene_statistics.h"

namespace scotopic {

/// Nanoseconds per pixel that each effect of the plan adds on this machine, one thread, measured on the
/// scene's samples; in the plan's order. 0 where nothing would run, or where there are too few samples to
/// time.
std::vector<double> measure_costs(const AppearanceParameters& asked, const ScenePlan& plan,
                                  const SceneStatistics& statistics);

/// One bar of the luminance histogram: from cd/m2 up to twice that.
struct LuminanceBar {
  double from = 0;
  double share = 0;
};

/// Octaves of luminance between the darkest and the brightest that hold light, in cd/m2. `dark`: share of
/// pixels at or below 0.
std::vector<LuminanceBar> luminance_bars(const SceneStatistics& statistics, double white_luminance);
double dark_share(const SceneStatistics& statistics);

/// What white luminance the picture speaks for, where the one used makes its log-average disagree with the
/// adaptation by more than a stop, or its lamps too dim to be lamps; empty: neither.
std::string unit_advice(const SceneStatistics& statistics, double adaptation, double white_luminance);

std::string luminance_text(const SceneStatistics& statistics, double white_luminance);
std::string effects_text(const ScenePlan& plan, const std::vector<double>& costs);

/// The bars, a row an octave; the first from -inf to 0 where there are such pixels.
std::string luminance_csv(const SceneStatistics& statistics, double white_luminance);

}  // namespace scotopic

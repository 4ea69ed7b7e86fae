// --adaptation auto[:METHOD]: what of a picture the eye is taken to be adapted to.
#pragma once

#include <optional>
#include <string>

#include "io/picture.h"
#include "scene/scene_statistics.h"

namespace scotopic {

struct AdaptationMethod {
  std::optional<double> quantile;  ///< of luminance, 0 to 1; absent: log-average
  std::optional<Window> region;    ///< only these pixels are metered
  std::string description = "log-average of the picture";
};

/// "auto", "auto:median", "auto:pNN" (a percentile) or "auto:X,Y,W,H" (log-average of a region, pixels of the display
/// window); nullopt for text that does not start with auto. Error(usage) for another method.
std::optional<AdaptationMethod> parse_adaptation_method(const std::string& text);

/// The adaptation luminance, image values.
double metered(const SceneStatistics& statistics, const AdaptationMethod& method);

}  // namespace scotopic

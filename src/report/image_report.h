// What --json says of images, from what the pipeline reports.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "report/console.h"
#include "pipeline/run.h"

namespace scotopic {

nlohmann::ordered_json image_json(const ImageReport& report);
/// Where an eye stands that is still adapting: log10 of thresholds over the absolute one, cd/m2, shares of
/// pigment.
nlohmann::ordered_json adapting_json(const AdaptationState& state, const AdaptationThresholds& thresholds);
nlohmann::ordered_json plan_json(const ScenePlan& plan);
/// Null for an image that is not spectral.
nlohmann::ordered_json spectral_json(const std::optional<SpectralReport>& report);

/// Says once how many pixels are not finite, where the first is, and what was `done` with them; nothing for
/// none.
void tell_non_finite(const NonFinitePixels& pixels, const std::string& file, const std::string& done,
                     const Console& console);

}  // namespace scotopic

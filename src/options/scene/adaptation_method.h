// --adaptation auto[:METHOD], as typed.
#pragma once

#include <optional>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// "auto", "auto:median", "auto:pNN" (a percentile) or "auto:X,Y,W,H" (log-average of a region, pixels of the
/// display window); nullopt for text that does not start with auto. Error(usage) for another method.
std::optional<AdaptationMethod> parse_adaptation_method(const std::string& text);

}  // namespace scotopic

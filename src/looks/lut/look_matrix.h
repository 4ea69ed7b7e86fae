// Looks that need no LUT.
#pragma once

#include <optional>

#include "stages/shared/parameters.h"

namespace scotopic {

/// The whole operator as a matrix on the RGB it is given: the identity where the plan (scene/plan.h) has
/// nothing to do; loss of colour where that is all it has to do, and the weight is global, so that no pixel
/// differs from the next. nullopt: pixels do. To the last digit of double.
std::optional<Matrix3<double>> look_matrix(const AppearanceParameters& parameters);

}  // namespace scotopic

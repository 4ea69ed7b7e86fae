#include "adaptation/thresholds.h"

#include "adaptation/closed_forms.h"

namespace scotopic {

double visible_difference(double luminance) noexcept { return closed_forms::visible_difference(luminance); }

double joint_sensitivity(double luminance) noexcept { return closed_forms::joint_sensitivity(luminance); }

double visibility_stops(double adaptation, VisibilityRule rule, double viewing) noexcept {
  return closed_forms::visibility_stops(adaptation, rule, viewing);
}

}  // namespace scotopic

#include "adaptation/thresholds.h"

#include <algorithm>
#include <cmath>

namespace scotopic {

double visible_difference(double luminance) noexcept {
  const double l = std::log10(luminance);
  const auto log_threshold = [l] {
    if (l <= -3.9506) return -2.86;
    if (l <= -1.2) return std::pow(0.405 * l + 1.6, 2.18) - 2.86;
    if (l <= -0.0184) return l - 0.395;
    if (l <= 1.9176) return std::pow(0.249 * l + 0.65, 2.7) - 0.72;
    return l - 1.255;
  };
  return std::pow(10.0, log_threshold());
}

double joint_sensitivity(double luminance) noexcept {
  return std::pow(std::pow(4.0627 / luminance, 1.6596) + 1, -0.2712);
}

double visibility_stops(double adaptation, VisibilityRule rule, double viewing) noexcept {
  if (rule == VisibilityRule::hdrvdp2)
    return std::min(0.0, std::log2(joint_sensitivity(adaptation) / joint_sensitivity(viewing)));
  const double visible = visible_difference(viewing) / visible_difference(adaptation);
  return std::min(0.0, std::log2(adaptation / viewing * visible));
}

}  // namespace scotopic

#include "stages/acuity/cutoff.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scotopic {
namespace {
constexpr double lowest_adaptation = 1e-5;  // cd/m2; Shlaer's dimmest measurements lie near 1e-4
}

double acuity_cutoff(double adaptation) noexcept {
  const double la = adaptation > lowest_adaptation ? adaptation : lowest_adaptation;
  return 17.25 * std::atan(1.4 * std::log10(la) + 0.35) + 25.72;
}

double acuity_sigma_pixels(double adaptation, double pixels_per_degree) noexcept {
  const double half_transfer = std::sqrt(2.0 * std::numbers::ln2) / (2.0 * std::numbers::pi);
  return half_transfer / acuity_cutoff(adaptation) * pixels_per_degree;
}

double pixels_per_degree(double width_pixels, double horizontal_fov_degrees) noexcept {
  const double radians = std::numbers::pi / 180.0;
  return 0.5 * width_pixels / std::tan(0.5 * horizontal_fov_degrees * radians) * radians;
}

bool acuity_is_not_limiting(double adaptation, double pixels_per_degree) noexcept {
  return 0.5 * pixels_per_degree <= acuity_cutoff(adaptation);
}

}  // namespace scotopic

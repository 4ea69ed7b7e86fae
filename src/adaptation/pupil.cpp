#include "adaptation/pupil.h"

#include <cmath>
#include <numbers>

namespace scotopic {

double pupil_diameter_mm(double adaptation) noexcept {
  constexpr double field_deg2 = 2827.43;
  constexpr double reference_flux = 846;  // cd/m2 deg2
  const double t = std::pow(adaptation * field_deg2 / reference_flux, 0.41);
  // 7.75 - 5.75 t/(t+2) written so that t = inf gives 2 mm, not NaN.
  return 2.0 + 5.75 * 2.0 / (t + 2.0);
}

double trolands_per_luminance(double adaptation) noexcept {
  const double d = pupil_diameter_mm(adaptation);
  return std::numbers::pi / 4 * d * d;
}

}  // namespace scotopic

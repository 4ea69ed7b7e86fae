#include "stages/glare/halo.h"

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

// Spencer et al. 1995, f3.
constexpr double peak = 436.9, steepness = 19.75, of_wavelength = 568, radius = 3;
constexpr double share_of_scotopic_eye = 0.033;
// The clear middle of the lens, and a pupil that shows its fibres whole: our reading.
constexpr double clear_mm = 3, open_mm = 7;

}  // namespace

double halo_radius(double wavelength) noexcept { return radius * wavelength / of_wavelength; }

double halo_psf(double theta, double wavelength) noexcept {
  const double beside = theta - halo_radius(wavelength);
  return peak * (of_wavelength / wavelength) * std::exp(-steepness * beside * beside);
}

double halo_share(double pupil_mm) noexcept {
  return share_of_scotopic_eye * std::clamp((pupil_mm - clear_mm) / (open_mm - clear_mm), 0.0, 1.0);
}

}  // namespace scotopic

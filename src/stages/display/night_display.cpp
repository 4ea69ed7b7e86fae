#include "stages/display/night_display.h"

#include <cmath>

#include "stages/display/night_display-inl.h"
#include "stages/shared/scalar-inl.h"
#include "stages/limits.h"

namespace scotopic {

double display_scale(const NightDisplayParameters& p) noexcept {
  const double scale = display_scale(
      DisplayLight<double>{p.adaptation, p.white_luminance, p.viewing, p.peak, p.strength}, p.rule);
  return std::abs(scale - 1) < 1e-12 ? 1 : scale;
}

Vec3<double> night_display(const NightDisplayParameters& p, const Vec3<double>& rgb) noexcept {
  for (const double x : rgb)
    if (!(std::abs(x) <= operable_limit)) return rgb;
  const HWY_NAMESPACE::Triple<double> out =
      HWY_NAMESPACE::night_display(HWY_NAMESPACE::Scalar<double>(), DisplayConstants<double>(p),
                                   DisplaySwitches(p), HWY_NAMESPACE::Triple<double>{rgb[0], rgb[1], rgb[2]});
  return {out.x, out.y, out.z};
}

}  // namespace scotopic

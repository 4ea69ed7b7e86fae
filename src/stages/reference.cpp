#include "stages/reference.h"

#include <algorithm>

#include "receptors/receptor_space.h"
#include "stages/pixel_stages-inl.h"
#include "stages/shared/scalar-inl.h"
#include "stages/limits.h"

namespace scotopic {
namespace {

namespace formulas = HWY_NAMESPACE;
using Number = formulas::Scalar<double>;

formulas::Triple<double> triple(const Vec3<double>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

double rod_signal_from_rgb(const OperatorConstants& c, const Vec3<double>& rgb) noexcept {
  const auto& p = c.parameters;
  const double scotopic = scotopic_luminance_from_xyz(p.xyz_from_rgb * rgb, p.rods, p.sp_ratio);
  return std::max(0.0, rod_signal_per_scotopic_luminance() * scotopic);
}

double luminance_ratio(double from, double to, double largest) noexcept {
  return formulas::ratio_of_luminances(Number(), from, to, luminance_floor * largest);
}

AppearanceReference::AppearanceReference(const AppearanceParameters& parameters)
    : c_(parameters), k_(c_), on_(c_) {}

Vec3<double> AppearanceReference::operator()(const ReferencePixel& pixel) const noexcept {
  const formulas::PixelStages<Number> see(Number(), k_, on_);
  const formulas::PixelIn<double> in{triple(pixel.rgb), triple(pixel.cones.value_or(Vec3<double>{})),
                                     pixel.rod.value_or(0), pixel.cones.has_value(), pixel.rod.has_value()};
  formulas::PixelStages<Number>::Seen seen{};
  if (!see(in, seen) || !seen.active) return pixel.rgb;
  return {seen.rgb.x, seen.rgb.y, seen.rgb.z};
}

}  // namespace scotopic

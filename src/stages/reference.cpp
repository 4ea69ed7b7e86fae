#include "stages/reference.h"

#include <algorithm>
#include <cmath>

#include "adaptation/mesopic.h"
#include "stages/table.h"
#include "receptors/receptor_space.h"

namespace scotopic {
namespace {

bool operable(double x) { return std::abs(x) <= operable_limit; }

bool operable(const Vec3<double>& v) { return operable(v[0]) && operable(v[1]) && operable(v[2]); }

bool operable(const ReferencePixel& p) {
  return operable(p.rgb) && (!p.cones || operable(*p.cones)) && (!p.rod || operable(*p.rod));
}

Vec3<double> scaled(double s, const Vec3<double>& v) { return {s * v[0], s * v[1], s * v[2]}; }

Vec3<double> sum(const Vec3<double>& a, const Vec3<double>& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

struct AppearanceReference::Light {
  Vec3<double> rgb;
  Vec3<double> cones;  // as given, or of rgb
  double rod;          // never negative
  double photopic;     // Y, image units
  double m;            // mesopic adaptation coefficient at Lloc
};

double rod_signal_from_rgb(const OperatorConstants& c, const Vec3<double>& rgb) noexcept {
  const auto& p = c.parameters;
  const double scotopic = scotopic_luminance_from_xyz(p.xyz_from_rgb * rgb, p.rods, p.sp_ratio);
  return std::max(0.0, rod_signal_per_scotopic_luminance() * scotopic);
}

double policy_luminance(const OperatorConstants& c, double photopic, double rod, double m) noexcept {
  if (c.parameters.luminance != LuminancePolicy::mesopic) return photopic;
  // MES2's own weighting, (m Y + (1-m) rho Rn C)/(m + (1-m) rho C), relative to a D65 white.
  const double rods = (1 - m) * sp_ratio_d65 * mes2_efficacy_ratio;
  return (m * photopic + rods * (rod / c.rod_white)) / (m + rods);
}

double luminance_ratio(double from, double to, double largest) noexcept {
  const double f = std::max(std::abs(from), luminance_floor * largest);
  if (!(f > 0) || to == from) return 1;
  const double u = from / f;
  constexpr double cap = 1e18;
  // Not u (to/f): 0 times infinity is no number.
  return std::clamp(u * to / f + (1 - u * u), 0.0, cap);
}

AppearanceReference::AppearanceReference(const AppearanceParameters& parameters)
    : c_(parameters), rgb_from_lms_cat02_(rgb_from_lms_cat02(parameters)) {
  if (c_.project) projection_.emplace(lms_from_xyz() * *parameters.xyz_from_gamut);
}

Vec3<double> AppearanceReference::shifted(const Light& in) const noexcept {
  const double unit = c_.parameters.white_luminance;
  const double w = c_.shift * (1 - in.m);
  if (!(w > 0)) return in.rgb;
  const Vec3<double> dq = c_.kernel.shift(scaled(unit, in.cones), unit * in.rod);
  return projected(sum(in.rgb, c_.rgb_from_lms * scaled(w / unit, dq)), in.rgb);
}

Vec3<double> AppearanceReference::projected(const Vec3<double>& rgb, const Vec3<double>& in) const noexcept {
  if (!c_.project) return rgb;
  const Vec3<double> target = c_.gamut_is_rgb ? rgb : c_.gamut_from_rgb * rgb;
  const Vec3<double> source = c_.gamut_is_rgb ? in : c_.gamut_from_rgb * in;
  Vec3<double> bound, z;
  for (std::size_t i = 0; i < 3; ++i) {
    bound[i] = std::min(0.0, source[i]);
    z[i] = target[i] - bound[i];
  }
  const Vec3<double> nearest = projection_->nearest(z);
  if (nearest == z) return rgb;
  const Vec3<double> result = sum(nearest, bound);
  return c_.gamut_is_rgb ? result : c_.rgb_from_gamut * result;
}

Vec3<double> AppearanceReference::with_luminance(const Vec3<double>& rgb, const Light& in) const noexcept {
  if (!(c_.luminance > 0)) return rgb;
  const double from = dot(c_.luminance_from_rgb, rgb);
  const double policy = policy_luminance(c_, in.photopic, in.rod, in.m);
  const double goal = in.photopic + c_.luminance_goal * (policy - in.photopic);
  // From the goal's side: at strength 1 this is the goal to the last digit, however far `from` is.
  const double to = goal + (1 - c_.luminance) * (from - goal);
  double largest = 0;
  for (const Vec3<double>& cones : {c_.lms_from_rgb * in.rgb, c_.lms_from_rgb * rgb})
    for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, std::abs(cones[i]) / c_.cone_white[i]);
  return scaled(luminance_ratio(from, to, largest), rgb);
}

Vec3<double> AppearanceReference::with_chroma(const Vec3<double>& rgb, double local_luminance) const noexcept {
  const double keep = 1 - c_.chroma * (1 - chroma_factor(local_luminance));
  if (keep == 1) return rgb;
  const double y = dot(c_.luminance_from_rgb, rgb);
  return {y + keep * (rgb[0] - y), y + keep * (rgb[1] - y), y + keep * (rgb[2] - y)};
}

Vec3<double> AppearanceReference::safko(const ReferencePixel& pixel) const noexcept {
  const double unit = c_.parameters.white_luminance;
  const Vec3<double> q = pixel.cones ? *pixel.cones : c_.lms_from_rgb * pixel.rgb;
  const double r = pixel.rod ? std::max(0.0, *pixel.rod) : rod_signal_from_rgb(c_, pixel.rgb);
  const Vec3<double> dq = c_.kernel.shift(scaled(unit, q), unit * r);
  return rgb_from_lms_cat02_ * sum(q, scaled(1 / unit, dq));
}

Vec3<double> AppearanceReference::operator()(const ReferencePixel& pixel) const noexcept {
  if (!operable(pixel)) return pixel.rgb;
  const auto& p = c_.parameters;
  if (p.model == Model::safko2019) return safko(pixel);
  const double y = dot(c_.luminance_from_rgb, pixel.rgb);
  const double local = p.adaptation + (p.weight == Weight::local ? std::max(0.0, y * p.white_luminance) : 0.0);
  if (!(local < photopic_luminance)) return pixel.rgb;

  const Light in{pixel.rgb, pixel.cones ? *pixel.cones : c_.lms_from_rgb * pixel.rgb,
                 pixel.rod ? std::max(0.0, *pixel.rod) : rod_signal_from_rgb(c_, pixel.rgb), y,
                 mesopic_coefficient(local)};
  return with_chroma(with_luminance(shifted(in), in), local);
}

}  // namespace scotopic

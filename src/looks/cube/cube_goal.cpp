#include "looks/cube/cube_goal.h"

#include <utility>

#include "looks/lut/look_chain.h"
#include "stages/shared/colour_difference.h"

namespace scotopic {
namespace {

Colours converted(const RowConverter& way, Colours c) {
  way.apply(c.r.data(), c.g.data(), c.b.data(), c.size());
  return c;
}

void scale(Colours& c, double factor) {
  for (auto* plane : {&c.r, &c.g, &c.b})
    for (float& x : *plane) x = static_cast<float>(static_cast<double>(x) * factor);
}

Comparison::Difference difference_of(const LookSpec& spec) {
  if (!spec.night) return exposed_difference;
  return spec.night->peak > display_white ? itp_difference : shown_difference;
}

}  // namespace

CubeGoal::CubeGoal(const LookSpec& spec, const ColourConfig& config)
    : parameters_(spec.parameters),
      lamp_(spec.lamp),
      night_(spec.night),
      to_light_(config.to_working(config.space(spec.space))),
      from_light_(config.from_working(config.space(spec.space))),
      to_codes_(config.from_working(config.space(spec.night ? spec.display : spec.space))),
      from_codes_(config.to_working(config.space(spec.night ? spec.display : spec.space))),
      difference_(difference_of(spec)) {}

Colours CubeGoal::light(Colours codes) const { return converted(to_light_, std::move(codes)); }

Colours CubeGoal::codes(Colours light) const { return converted(from_light_, std::move(light)); }

Colours CubeGoal::exact(const Colours& codes) const {
  Colours out = seen_under(lamp_, parameters_, light(codes));
  if (night_) {
    out = exact_night(parameters_, *night_, std::move(out));
    scale(out, night_->peak / display_white);
  } else {
    out = scotopic::exact(parameters_, std::move(out));
  }
  return converted(to_codes_, std::move(out));
}

Colours CubeGoal::light_out(Colours codes) const { return converted(from_codes_, std::move(codes)); }

std::vector<Vec3<double>> CubeGoal::seen(Colours codes) const {
  const Colours c = light_out(std::move(codes));
  std::vector<Vec3<double>> out;
  out.reserve(c.size());
  for (std::size_t i = 0; i < c.size(); ++i)
    out.push_back(parameters_.xyz_from_rgb * Vec3<double>{c.r[i], c.g[i], c.b[i]});
  return out;
}

}  // namespace scotopic

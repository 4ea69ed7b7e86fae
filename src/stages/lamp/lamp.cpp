#include "stages/lamp/lamp.h"

#include <algorithm>

namespace scotopic {

double lamp_degree(const Lamp& lamp, const AppearanceParameters& p) noexcept {
  return p.strength.all * adaptation_degree(p.adaptation, lamp.surround);
}

Matrix3<double> lamp_matrix(const Lamp& lamp, const AppearanceParameters& p) noexcept {
  return adapt_to_lamp(lamp.white, lamp_degree(lamp, p));
}

bool changes_light(const Lamp& lamp, const AppearanceParameters& p) noexcept {
  return lamp_matrix(lamp, p).rows != identity3<double>().rows;
}

Vec3<double> faded(const Vec3<double>& seen, const Vec3<double>& in, const Vec3<double>& y_row) noexcept {
  const double floor = std::min({0.0, in[0], in[1], in[2]});
  const double least = std::min({seen[0], seen[1], seen[2]}), grey = dot(y_row, seen);
  if (!(least < floor) || !(grey > floor)) return seen;
  const double keep = (grey - floor) / (grey - least);
  return {grey + keep * (seen[0] - grey), grey + keep * (seen[1] - grey), grey + keep * (seen[2] - grey)};
}

LampOnRgb::LampOnRgb(const Lamp& lamp, const AppearanceParameters& p) noexcept
    : rgb_(inverse(p.xyz_from_rgb) * (lamp_matrix(lamp, p) * p.xyz_from_rgb)), y_row_(p.xyz_from_rgb[1]) {}

}  // namespace scotopic

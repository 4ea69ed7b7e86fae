#include "looks/cube/cube_colours.h"

#include <algorithm>

#include "color/primaries.h"

namespace scotopic {
namespace {

void append(Colours& to, const Colours& from, std::size_t i) {
  to.r.push_back(from.r[i]);
  to.g.push_back(from.g[i]);
  to.b.push_back(from.b[i]);
}

Colours inside_ap1(const Colours& light, const Matrix3<double>& xyz_from_working) {
  const Matrix3<double> ap1 = inverse(gamut_xyz_matrix("ap1").value()) * xyz_from_working;
  constexpr double rounding = 1e-6;
  Colours out;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Vec3<double> c = ap1 * Vec3<double>{light.r[i], light.g[i], light.b[i]};
    if (std::min({c[0], c[1], c[2]}) >= -rounding * std::max({c[0], c[1], c[2]})) append(out, light, i);
  }
  return out;
}

bool is_code(float x) { return x >= 0 && x <= 1; }

}  // namespace

CodedColours coded_colours(const CubeGoal& goal, const Matrix3<double>& xyz_from_gamut,
                           const Matrix3<double>& xyz_from_working, std::size_t count,
                           const StopRange& range) {
  const Colours all =
      goal.codes(inside_ap1(stop_colours(count, xyz_from_gamut, xyz_from_working, range), xyz_from_working));
  CodedColours out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (is_code(all.r[i]) && is_code(all.g[i]) && is_code(all.b[i])) append(out.codes, all, i);
  if (all.size() > 0)
    out.without_code = 1 - static_cast<double>(out.codes.size()) / static_cast<double>(all.size());
  return out;
}

}  // namespace scotopic

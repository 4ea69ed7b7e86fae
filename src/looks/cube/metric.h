// How much a small change of a code matters.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "looks/cube/cube_goal.h"

namespace scotopic {

/// Symmetric: xx, yy, zz, xy, xz, yz. The square of the difference that a change d of the code makes is d' M
/// d.
using Metric = std::array<float, 6>;

/// Of each code out, by the goal's difference over steps of 1/1000.
std::vector<Metric> local_metrics(const CubeGoal& goal, const Colours& out);

inline Vec3<double> operator*(const Metric& m, const Vec3<double>& d) {
  const auto at = [&](std::size_t i) { return static_cast<double>(m[i]); };
  return {at(0) * d[0] + at(3) * d[1] + at(4) * d[2], at(3) * d[0] + at(1) * d[1] + at(5) * d[2],
          at(4) * d[0] + at(5) * d[1] + at(2) * d[2]};
}

}  // namespace scotopic

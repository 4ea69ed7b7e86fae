// The colours that a cube is fitted to and measured on, as codes of its space.
#pragma once

#include <cstddef>

#include "looks/cube/cube_goal.h"

namespace scotopic {

/// Stops of white that cubes are made for: those of footage. (Looks of a config hold 28.)
inline constexpr double cube_darkest = -8, cube_brightest = 5;

/// Codes within 0 to 1.
struct CodedColours {
  Colours codes;
  double without_code = 0;  ///< share of the colours asked for that have none
};

/// `count` colours of a gamut, over the stops, as stop_colours has them, those outside AP1 left out: no
/// camera means them.
CodedColours coded_colours(const CubeGoal& goal, const Matrix3<double>& xyz_from_gamut,
                           const Matrix3<double>& xyz_from_working, std::size_t count,
                           const StopRange& range);

}  // namespace scotopic

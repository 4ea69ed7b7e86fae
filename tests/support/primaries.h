// Linear RGB spaces for tests, from chromaticities.
#pragma once

#include "kernel/matrix3.h"

namespace scotopic::test {

/// XYZ (Y = 1 at RGB 1,1,1) from RGB of the given primaries and white; no chromatic adaptation.
constexpr Matrix3<double> xyz_from_rgb(const Vec3<double>& x, const Vec3<double>& y, double white_x,
                                       double white_y) {
  Matrix3<double> primaries;
  for (std::size_t i = 0; i < 3; ++i) {
    primaries[0][i] = x[i] / y[i];
    primaries[1][i] = 1;
    primaries[2][i] = (1 - x[i] - y[i]) / y[i];
  }
  const Vec3<double> white = {white_x / white_y, 1, (1 - white_x - white_y) / white_y};
  return primaries * diagonal(inverse(primaries) * white);
}

inline constexpr Matrix3<double> rec709 =
    xyz_from_rgb({0.64, 0.30, 0.15}, {0.33, 0.60, 0.06}, 0.3127, 0.3290);
inline constexpr Matrix3<double> rec2020 =
    xyz_from_rgb({0.708, 0.170, 0.131}, {0.292, 0.797, 0.046}, 0.3127, 0.3290);

}  // namespace scotopic::test

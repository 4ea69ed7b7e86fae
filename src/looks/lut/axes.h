// Where the nodes of a look's 3D LUT lie: three axes that put them where the operator bends.
#pragma once

#include <optional>
#include <vector>

#include "kernel/matrix3.h"

namespace scotopic {

/// Brightness. Input: log2 of a luminance-like quantity in cd/m2; output: 0 to 1. The density of nodes per
/// stop
///   1/(2^((a - x)/p) + 1 + 2^((x - b)/q)) (1 + bump) + floor
/// is that of a p-th root in the dark - so that what is proportional to the light stays exactly so under
/// linear interpolation, down to black -, even over the mesopic range, and low above it, where the operator
/// is the identity; the bump lies where strong blues become photopic. Its constants are the result of a
/// search for the least CIEDE2000 at 0.001 to 1 cd/m2.
///
/// With the display stage behind the operator, nodes lie where light reaches the display's peak and bends: a
/// Gaussian of 5 stops around it, and few from 9 stops above it on.
class LevelAxis {
 public:
  /// `highest`: log2 of the brightest level; at least the lowest, -80, which stands for black. `peak`: log2
  /// of the level of the display's peak, where there is a display.
  explicit LevelAxis(double highest, std::optional<double> peak = std::nullopt);

  /// log2 of the level that stands for black.
  double lowest() const noexcept { return lowest_; }
  /// log2 of the brightest level.
  double highest() const noexcept { return highest_; }

  /// Non-decreasing; 0 at or below lowest(), 1 at or above highest(). To 64 ulp of 1 of the tabulated axis.
  double position(double log2_level) const noexcept;
  /// Inverse of position on [0, 1]. To 64 ulp of 80.
  double log2_level(double position) const noexcept;

 private:
  static constexpr double lowest_ = -80;
  double highest_;
  std::vector<double> table_;
};

/// A share between two quantities, 0 to 1. Denser towards both ends, where gamuts end and colours are strong;
/// 1/2 (white) stays 1/2, which is a node of every LUT of 2^k + 1 nodes.
class ShareAxis {
 public:
  ShareAxis();

  /// Non-decreasing from 0 at share 0 to 1 at share 1, 1/2 at 1/2. To 32 ulp of 1 of the tabulated axis.
  double position(double share) const noexcept;
  /// Inverse of position on [0, 1]. To 32 ulp of 1.
  double share(double position) const noexcept;

 private:
  std::vector<double> table_;
};

/// Coordinates of a colour in the LUT. Three positive quantities a, b, c - RGB of AP1 (AMPAS S-2014-004),
/// which holds every colour of the usual working spaces, with red and blue at half weight so that white lies
/// at the centre - in the order blue, red, green give the shares a/(a+b), (a+b)/(a+b+c) and the level a+b+c.
struct LookCoordinates {
  /// Weighted AP1 (blue, red, green) from D65-adapted XYZ.
  static Matrix3<double> from_xyz();
  /// (a, a + b, a + b + c) from (a, b, c), and back.
  static constexpr Matrix3<double> cumulative{{{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}}}};
  static constexpr Matrix3<double> differences{{{{1, 0, 0}, {-1, 1, 0}, {0, -1, 1}}}};
};

}  // namespace scotopic

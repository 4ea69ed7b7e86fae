#include "looks/lut/axes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scotopic {
namespace {

TEST(LevelAxis, position_and_level_are_inverse_and_rise) {
  const LevelAxis axis(24);
  double last = -1;
  for (double x = -79; x < 24; x += 0.13) {
    const double t = axis.position(x);
    EXPECT_GT(t, last);
    EXPECT_NEAR(axis.log2_level(t), x, 1e-6);
    last = t;
  }
  EXPECT_EQ(axis.position(-80), 0);
  EXPECT_EQ(axis.position(-1e9), 0);
  EXPECT_EQ(axis.position(24), 1);
  EXPECT_EQ(axis.position(1e9), 1);
}

TEST(LevelAxis, darkness_is_a_root_of_the_light) {
  const LevelAxis axis(24);
  // Position over 2^(x/5.4) is constant where nodes serve only to reach black.
  const double at_40 = axis.position(-40) / std::exp2(-40 / 5.4);
  for (const double x : {-30.0, -36.0, -50.0})
    EXPECT_NEAR(axis.position(x) / std::exp2(x / 5.4) / at_40, 1, 0.06) << x;
}

TEST(LevelAxis, most_nodes_lie_between_a_millionth_and_a_hundred_candelas) {
  const LevelAxis axis(24);
  EXPECT_GT(axis.position(std::log2(100)) - axis.position(std::log2(1e-6)), 0.7);
}

TEST(ShareAxis, white_is_a_node_and_ends_are_ends) {
  const ShareAxis axis;
  EXPECT_EQ(axis.position(0), 0);
  EXPECT_EQ(axis.position(1), 1);
  EXPECT_NEAR(axis.position(0.5), 0.5, 1e-12);
  for (double u = 0.001; u < 1; u += 0.013) {
    EXPECT_NEAR(axis.share(axis.position(u)), u, 1e-9);
    EXPECT_NEAR(axis.position(u) + axis.position(1 - u), 1, 1e-9);
  }
}

TEST(LookCoordinates, white_of_one_candela_has_halves_and_a_level_of_two) {
  const Vec3<double> abc =
      LookCoordinates::from_xyz() * Vec3<double>{0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
  EXPECT_NEAR(abc[0] / (abc[0] + abc[1]), 0.5, 1e-9);
  EXPECT_NEAR((abc[0] + abc[1]) / (abc[0] + abc[1] + abc[2]), 0.5, 1e-9);
  EXPECT_NEAR(abc[0] + abc[1] + abc[2], 2, 1e-9);
}

}  // namespace
}  // namespace scotopic

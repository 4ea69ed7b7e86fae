// Rod input by level: the table's own values, straight between them, held beyond.
#include "kernel/rod_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scotopic {
namespace {

TEST(RodInput, is_the_published_table) {
  const struct {
    double lloc, lm, s, tolerance;
  } cases[] = {
      {0.1027, 0.172619, 0.714286, 1e-15},
      {0.6228, 0.0172619, 0.0202381, 1e-15},
      {10.0459, 0, 0, 1e-15},
      {0.2, 0.143555, 0.584444, 1e-6},
      {1.0, 0.016571, 0.019428, 1e-6},
      {0.0, 0.172619, 0.714286, 0},
      {1e-5, 0.172619, 0.714286, 0},
      {11, 0, 0, 0},
      {1e30, 0, 0, 0},
      {std::numeric_limits<double>::infinity(), 0, 0, 0},
      {std::nan(""), 0.172619, 0.714286, 0},
  };
  for (const auto& c : cases) {
    const Vec3<double> kappa = cao2008_kappa(c.lloc);
    EXPECT_NEAR(kappa[0], c.lm, c.tolerance) << c.lloc;
    EXPECT_EQ(kappa[0], kappa[1]) << c.lloc;
    EXPECT_NEAR(kappa[2], c.s, c.tolerance) << c.lloc;
  }
}

TEST(RodInput, falls_and_never_jumps) {
  Vec3<double> before = cao2008_kappa(0.05);
  for (double lloc = 0.05; lloc < 12; lloc *= 1.001) {
    const Vec3<double> kappa = cao2008_kappa(lloc);
    for (std::size_t i : {0u, 2u}) {
      EXPECT_LE(kappa[i], before[i]) << lloc;
      EXPECT_LT(before[i] - kappa[i], 1e-3) << lloc;
    }
    before = kappa;
  }
}

// From 0.1 to 0.6 cd/m2 it falls tenfold: the reason for the table.
TEST(RodInput, falls_tenfold_from_a_tenth_to_six_tenths) {
  EXPECT_NEAR(cao2008_kappa(0.1)[0] / cao2008_kappa(0.6228)[0], 10.0, 1e-4);
}

}  // namespace
}  // namespace scotopic

#include "adaptation/pupil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scotopic {
namespace {

TEST(Pupil, trolands_per_luminance_follow_watson_yellott) {
  // Evaluated independently from the paper's equations 20 and 21 for a 60 degree disc, both eyes, age 28.58.
  const struct { double adaptation, trolands; } rows[] = {{0.01, 39.76}, {1, 20.91}, {100, 6.59}};
  for (const auto& row : rows) EXPECT_NEAR(trolands_per_luminance(row.adaptation), row.trolands, 0.005);
}

TEST(Pupil, diameter_runs_from_7_75_mm_in_the_dark_down_to_2_mm) {
  EXPECT_EQ(pupil_diameter_mm(0), 7.75);
  EXPECT_EQ(pupil_diameter_mm(std::numeric_limits<double>::infinity()), 2.0);
  double before = 8;
  for (double la = 1e-6; la < 1e8; la *= 2) {
    EXPECT_LT(pupil_diameter_mm(la), before);
    before = pupil_diameter_mm(la);
  }
}

}  // namespace
}  // namespace scotopic

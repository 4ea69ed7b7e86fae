#include "adaptation/mesopic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace scotopic {
namespace {

TEST(Mesopic, coefficients_of_a_daylight_agree_with_cie_191) {
  const struct {
    double photopic, m;
  } rows[] = {{5, 1}, {100, 1}, {1, 0.786554}, {0.1, 0.486223}, {0.01, 0.194526}, {0.001, 0}};
  for (const auto& row : rows)
    EXPECT_NEAR(mesopic_state(row.photopic, 2.47 * row.photopic).adaptation_coefficient, row.m, 1e-6)
        << row.photopic;
}

TEST(Mesopic, newton_and_the_iteration_of_the_standard_meet) {
  double worst = 0;
  for (const double sp : {0.645, 1.41, 2.04, 2.4648, 4.0})
    for (double lp = 1e-4; lp < 20; lp *= 1.07) {
      const double standard = mesopic_state(lp, sp * lp).adaptation_coefficient;
      worst = std::max(worst, std::abs(mesopic_coefficient(lp, sp) - standard));
    }
  std::printf("MES2: Newton against iteration, worst difference %.3g\n", worst);
  EXPECT_LE(worst, 2e-15);
}

TEST(Mesopic, no_light_is_scotopic_never_nan) {
  EXPECT_EQ(mesopic_state(0, 0).adaptation_coefficient, 0);
  EXPECT_EQ(mesopic_coefficient(0), 0);
}

TEST(Mesopic, m_reaches_exactly_one_and_zero_at_its_limits) {
  EXPECT_EQ(mesopic_coefficient(5.0), 1);
  EXPECT_EQ(mesopic_coefficient(mesopic_photopic_limit()), 1);
  EXPECT_LT(mesopic_coefficient(std::nextafter(mesopic_photopic_limit(), 0) * (1 - 1e-12)), 1);
  EXPECT_EQ(mesopic_coefficient(0.001), 0);
  EXPECT_EQ(mesopic_coefficient(mesopic_scotopic_limit()), 0);
  EXPECT_GT(mesopic_coefficient(mesopic_scotopic_limit() * (1 + 1e-12)), 0);
}

TEST(Mesopic, m_rises_with_luminance) {
  double before = 0;
  for (double lp = 1e-4; lp < 10; lp *= 1.0005) {
    const double m = mesopic_coefficient(lp);
    EXPECT_GE(m, before) << lp;
    before = m;
  }
}

}  // namespace
}  // namespace scotopic

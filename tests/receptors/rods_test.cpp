#include "receptors/rods.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "receptors/support.h"

namespace scotopic {
namespace {

constexpr Vec3<double> d65_white = {0.95047, 1.0, 1.08883};
constexpr RodEstimate both[] = {RodEstimate::linear, RodEstimate::quadratic};

double estimate(const Vec3<double>& xyz, RodEstimate kind, double sp = sp_ratio_d65) {
  return scotopic_luminance_from_xyz(xyz, kind, sp);
}

Vec3<double> scaled(const Vec3<double>& v, double by) { return {v[0] * by, v[1] * by, v[2] * by}; }

TEST(Rods, d65_white_is_exact) {
  for (RodEstimate kind : both) EXPECT_NEAR(estimate(d65_white, kind), 2.4648, 5e-5);
}

TEST(Rods, the_polynomials_are_as_published) {
  // Worked by hand from the coefficients at X = .4, Y = .3, Z = .2, so x = 4/9, y = 1/3.
  EXPECT_NEAR(estimate({0.4, 0.3, 0.2}, RodEstimate::linear), 0.452002176, 1e-12);
  EXPECT_NEAR(estimate({0.4, 0.3, 0.2}, RodEstimate::quadratic), 0.42806695011, 1e-11);
}

TEST(Rods, the_illuminant_scales_the_estimate) {
  for (RodEstimate kind : both)
    for (double sp : {0.645, 1.41, 2.04})
      EXPECT_NEAR(estimate(d65_white, kind, sp), estimate(d65_white, kind) * sp / 2.4648, 1e-15);
}

TEST(Rods, linear_estimate_of_deep_red_is_the_floor) {
  EXPECT_DOUBLE_EQ(estimate({0.7, 0.28, 0.0}, RodEstimate::linear), 0.016 * 0.28);
}

TEST(Rods, no_colour_falls_below_the_floor) {
  int on_floor = 0;
  for (RodEstimate kind : both)
    for (double x = 0.0; x <= 1.0; x += 1.0 / 64)
      for (double y = 0.0; x + y <= 1.0; y += 1.0 / 64) {
        const double rods = estimate({x, y, 1.0 - x - y}, kind, 0.645);
        ASSERT_GE(rods, 0.016 * y) << "x " << x << " y " << y;
        if (rods == 0.016 * y) ++on_floor;
      }
  EXPECT_GT(on_floor, 100);
}

TEST(Rods, black_gives_nothing) {
  for (RodEstimate kind : both) {
    EXPECT_EQ(estimate({0.0, 0.0, 0.0}, kind), 0.0);
    EXPECT_EQ(estimate({-0.0, -0.0, -0.0}, kind), 0.0);
  }
}

TEST(Rods, estimate_is_homogeneous_over_forty_decades) {
  for (RodEstimate kind : both)
    for (double by : {0x1p-66, 0x1p-20, 0x1p66}) {
      const Vec3<double> xyz = {0.3, 0.4, 0.6};
      EXPECT_DOUBLE_EQ(estimate(scaled(xyz, by), kind), by * estimate(xyz, kind));
    }
}

TEST(Rods, negative_components_keep_the_quadratic_finite_and_continuous) {
  const double step = 1e-7;
  test::WorstError worst;
  for (double x = -1.0; x <= 1.0; x += 0.125)
    for (double y = -1.0; y <= 1.0; y += 0.125)
      for (double z = -1.0; z <= 1.0; z += 0.125) {
        const double here = estimate({x, y, z}, RodEstimate::quadratic);
        ASSERT_TRUE(std::isfinite(here));
        for (const Vec3<double>& near :
             {Vec3<double>{x + step, y, z}, Vec3<double>{x, y + step, z}, Vec3<double>{x, y, z + step}})
          worst.add("X " + std::to_string(x) + " Y " + std::to_string(y) + " Z " + std::to_string(z),
                    estimate(near, RodEstimate::quadratic), here, 12 * step);
      }
  worst.expect_within("change per step, against the bound 12 on the gradient");
}

TEST(Rods, float_agrees_with_double) {
  test::WorstError worst;
  for (RodEstimate kind : both)
    for (float x : {0.1f, 0.5f, 0.9f})
      for (float z : {0.01f, 0.5f, 1.2f}) {
        const double exact = estimate({x, 0.5, z}, kind);
        const float rounded = scotopic_luminance_from_xyz<float>({x, 0.5f, z}, kind, 2.4648f);
        worst.add("X " + std::to_string(x) + " Z " + std::to_string(z), static_cast<double>(rounded), exact,
                  1e-6);
      }
  worst.expect_within("float against double");
}

TEST(Rods, nan_is_not_hidden_where_luminance_is_nan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (RodEstimate kind : both) EXPECT_TRUE(std::isnan(estimate({nan, nan, nan}, kind)));
}

}  // namespace
}  // namespace scotopic

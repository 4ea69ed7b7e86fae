// The function itself: published values, its integral, and its sum of Gaussians.
#include "stages/glare/psf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace scotopic {
namespace {

// 2 pi times the integral of psf sin(theta) d theta, by Simpson's rule in asinh(theta/0.001).
double light_within(const GlareFunction& function, double from, double to) {
  constexpr int steps = 20000;
  const double radians = std::numbers::pi / 180, a = std::asinh(from / 1e-3),
               h = (std::asinh(to / 1e-3) - a) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double theta = 1e-3 * std::sinh(a + i * h);
    const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * function.psf(theta) * std::sin(theta * radians) * 1e-3 * std::cosh(a + i * h);
  }
  return 2 * std::numbers::pi * radians * sum * h / 3;
}

TEST(GlareFunction, is_the_published_one) {
  // The formula in mpmath, 30 digits, age 28.58, pigmentation 0.5; over N by mpmath's quadrature.
  const double expected[][2] = {{0, 9040151.47802},   {0.01, 785082.219914},  {0.05, 51045.9890221},
                                {0.1, 11319.2917127}, {0.3, 566.81237417},    {0.5, 131.978271632},
                                {1, 18.7372488682},   {2, 2.87153576842},     {3, 1.00960244459},
                                {10, 0.06047423585},  {30, 0.00763122456127}, {60, 0.00318772105691}};
  const GlareFunction function({});
  for (const auto& [theta, psf] : expected) EXPECT_NEAR(function.psf(theta) / psf, 1, 1e-11) << theta;
}

TEST(GlareFunction, is_divided_by_its_integral_over_the_hemisphere) {
  const struct {
    GlareEye eye;
    double normalisation;  // mpmath
  } cases[] = {{{28.58, 0.5}, 1.03209683244161},
               {{20, 0}, 1.00487428070778},
               {{70, 0.5}, 1.06640275785544},
               {{80, 1.2}, 1.19852113842962}};
  for (const auto& c : cases) {
    const GlareFunction function(c.eye);
    EXPECT_NEAR(function.normalisation(), c.normalisation, 1e-13) << c.eye.age;
    EXPECT_NEAR(light_within(function, 0, 90), 1, 1e-12) << c.eye.age;
  }
}

TEST(GlareFunction, leaves_this_share_of_a_point_outside_a_radius) {
  // Degrees, share: computed in double when the function was chosen.
  const double expected[][2] = {{1.0 / 60, 0.700363}, {0.1, 0.318574}, {0.3, 0.149108}, {1, 0.075396},
                                {3, 0.047985},        {10, 0.031462},  {30, 0.018824}};
  const GlareFunction function({});
  for (const auto& [radius, share] : expected)
    EXPECT_NEAR(light_within(function, radius, 90), share, 1e-6) << radius;
}

// Of a point in the middle of a square in the plane of angles, in polar coordinates about it: Simpson's rule
// over an eighth of the directions.
double light_in_square(const GlareFunction& function, double side) {
  constexpr int steps = 16;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double angle = static_cast<double>(i) / steps * std::numbers::pi / 4;
    const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * light_within(function, 0, side / 2 / std::cos(angle));
  }
  return sum / (3 * steps);
}

TEST(GlareFunction, leaves_this_share_of_a_point_outside_a_square_picture) {
  const double expected[][2] = {{5, 0.049316},  {10, 0.038635}, {20, 0.030210},
                                {40, 0.022366}, {60, 0.017386}, {90, 0.011501}};
  for (const auto& [side, share] : expected)
    EXPECT_NEAR(1 - light_in_square(GlareFunction({}), side), share, 1e-6) << side;
}

TEST(GlareFunction, leaves_this_share_of_a_point_on_its_own_pixel) {
  const double expected[][2] = {{10, 0.542593}, {20, 0.387317}, {40, 0.272915}, {60, 0.212217}};
  for (const auto& [ppd, share] : expected)
    EXPECT_NEAR(light_in_square(GlareFunction({}), 1 / ppd), share, 1e-6) << ppd;
}

TEST(GlareFunction, decreases_to_90_degrees_for_every_eye) {
  for (double age = 0; age <= 100; age += 10)
    for (const double p : {0.0, 0.5, 1.0, 1.2}) {
      const GlareFunction function({age, p});
      for (double theta = 1e-4; theta < 89; theta *= 1.05)
        EXPECT_LT(function.psf(1.05 * theta), function.psf(theta)) << age << " " << p << " " << theta;
    }
}

TEST(GlareFunction, gaussians_an_octave_apart_sum_to_it_from_any_sigma_on) {
  double worst = 0, at = 0, of_age = 0, of_sigma = 0;
  for (const double age : {20.0, 28.58, 50.0, 80.0})
    for (const double p : {0.0, 0.5, 1.2})
      for (const double first : {0.001, 0.0012, 0.0014, 0.0017}) {
        const GlareFunction function({age, p});
        for (double theta = 0.02; theta <= 90; theta *= 1.1) {
          double sum = function.wide(theta);
          for (int j = -4; j < 40; ++j) {
            const double sigma = first * std::exp2(j);
            sum += function.rung(sigma) * std::exp(-theta * theta / (2 * sigma * sigma));
          }
          const double error = std::abs(sum / function.psf(theta) - 1);
          if (error > worst) worst = error, at = theta, of_age = age, of_sigma = first;
        }
      }
  std::printf("  worst relative error %.4f at %.3f degrees, age %.0f, first sigma %.4f\n", worst, at, of_age,
              of_sigma);
  EXPECT_LT(worst, 0.0208);  // 2 |Gamma(1.5 + 2 pi i/(2 ln 2))|/Gamma(1.5)
  EXPECT_GT(worst, 0.01);
}

TEST(GlareFunction, rungs_are_these) {
  const double expected[][2] = {{0.016, 1.463388138e5}, {0.032, 9.753968078e4},  {0.064, 2.420606231e4},
                                {0.128, 3758.303117},   {0.256, 517.2947175},    {0.512, 71.01033420},
                                {1.024, 10.26761813},   {2.048, 1.627689706},    {4.096, 0.2912536272},
                                {8.192, 0.05936502410}, {16.384, 0.01367185955}, {32.768, 0.003527948345}};
  const GlareFunction function({});
  for (const auto& [sigma, rung] : expected) EXPECT_NEAR(function.rung(sigma) / rung, 1, 2e-8) << sigma;
}

TEST(GlareFunction, older_and_lighter_eyes_scatter_more) {
  const double young = GlareFunction({25, 0.5}).psf(3);
  // At 3 degrees half of a young eye's light is the core's, which does not grow with age.
  EXPECT_NEAR(GlareFunction({75, 0.5}).psf(3) / young, 1.834, 0.001);
  EXPECT_GT(GlareFunction({25, 1.2}).psf(3), young);
}

TEST(GlareFunction, is_near_the_general_disability_glare_equation) {
  // CIE 146:2002 at these angles, and the ratio of psf to it where it is known.
  const double expected[][3] = {{0.1, 1.05223856e4, 1.08}, {0.3, 428.530295, 1.32},   {0.5, 100.980120, 0},
                                {1, 15.2720607, 1.23},     {2, 2.58199925, 0},        {3, 0.968862952, 1.04},
                                {10, 0.0686548696, 0.88},  {30, 0.00915838354, 0.83}, {60, 0.00361568496, 0}};
  const GlareFunction function({});
  for (const auto& [theta, veil, ratio] : expected) {
    EXPECT_NEAR(cie146_veil(theta, {}) / veil, 1, 1e-8) << theta;
    if (ratio > 0) {
      EXPECT_NEAR(function.psf(theta) / veil, ratio, 0.006) << theta;
    }
  }
  EXPECT_NEAR(stiles_holladay_veil(10, 70), 0.2, 1e-15);
}

TEST(GlareFunction, refuses_eyes_outside_its_domain) {
  EXPECT_THROW(GlareFunction({-1, 0.5}), std::invalid_argument);
  EXPECT_THROW(GlareFunction({101, 0.5}), std::invalid_argument);
  EXPECT_THROW(GlareFunction({30, 1.3}), std::invalid_argument);
  EXPECT_THROW(GlareFunction({std::nan(""), 0.5}), std::invalid_argument);
}

}  // namespace
}  // namespace scotopic

#include "stages/shared/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "receptors/receptor_space.h"
#include "support/primaries.h"

namespace scotopic {
namespace {

const Matrix3<double> lms_from_rgb = lms_from_xyz() * test::rec709;

double distance(const Vec3<double>& a, const Vec3<double>& b) {
  const Vec3<double> d = lms_from_rgb * Vec3<double>{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return std::sqrt(dot(d, d));
}

// Independent: projected gradient descent on the same convex problem, thousands of steps.
Vec3<double> by_descent(const Vec3<double>& z) {
  const Matrix3<double> gram = transpose(lms_from_rgb) * lms_from_rgb;
  const double step = 1 / (gram[0][0] + gram[1][1] + gram[2][2]);
  Vec3<double> p = {std::max(0.0, z[0]), std::max(0.0, z[1]), std::max(0.0, z[2])};
  for (int i = 0; i < 200000; ++i) {
    const Vec3<double> gradient = gram * Vec3<double>{p[0] - z[0], p[1] - z[1], p[2] - z[2]};
    for (std::size_t k = 0; k < 3; ++k) p[k] = std::max(0.0, p[k] - step * gradient[k]);
  }
  return p;
}

TEST(Projection, is_the_nearest_allowed_colour_in_lms) {
  const GamutProjection<double> projection(lms_from_rgb);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double worst = 0;
  int negatives[4] = {};
  for (int i = 0; i < 40; ++i) {
    const Vec3<double> z = {normal(random), normal(random), normal(random)};
    ++negatives[(z[0] < 0) + (z[1] < 0) + (z[2] < 0)];
    worst = std::max(worst, distance(projection.nearest(z), by_descent(z)));
  }
  for (int n : negatives) EXPECT_GT(n, 0);
  std::printf("projection against descent: worst distance %.3g\n", worst);
  EXPECT_LE(worst, 1e-8);
}

TEST(Projection, optimality_conditions_hold_for_every_sign_pattern) {
  const GamutProjection<double> projection(lms_from_rgb);
  const Matrix3<double> gram = transpose(lms_from_rgb) * lms_from_rgb;
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200000; ++i) {
    const Vec3<double> z = {normal(random), normal(random), normal(random)};
    const Vec3<double> p = projection.nearest(z);
    const Vec3<double> multiplier = gram * Vec3<double>{p[0] - z[0], p[1] - z[1], p[2] - z[2]};
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_GE(p[k], 0);
      ASSERT_GE(multiplier[k], -1e-12);
      ASSERT_NEAR(multiplier[k] * p[k], 0, 1e-12);
    }
  }
}

TEST(Projection, leaves_what_is_inside_bit_for_bit) {
  const GamutProjection<double> projection(lms_from_rgb);
  for (const Vec3<double>& z : {Vec3<double>{0, 0, 0}, {1, 2, 3}, {0, 1e-300, 5e-324}, {1e300, 0, 1}})
    EXPECT_EQ(projection.nearest(z), z);
}

TEST(Projection, never_widens_distances) {
  const GamutProjection<double> projection(lms_from_rgb);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100000; ++i) {
    const Vec3<double> a = {normal(random), normal(random), normal(random)};
    const double step = std::exp2(-10.0 * std::abs(normal(random)));
    const Vec3<double> b = {a[0] + step * normal(random), a[1] + step * normal(random),
                            a[2] + step * normal(random)};
    ASSERT_LE(distance(projection.nearest(a), projection.nearest(b)), distance(a, b) * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace scotopic

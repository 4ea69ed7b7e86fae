#include "kernel/matrix3.h"

#include <gtest/gtest.h>

namespace scotopic {
namespace {

constexpr Matrix3<double> m{{{{2, -1, 0.5}, {0.25, 3, -1}, {-0.5, 1, 4}}}};

TEST(Matrix3, inverse_times_matrix_is_the_identity) {
  const Matrix3<double> product = inverse(m) * m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 4e-16);
}

TEST(Matrix3, product_applies_the_right_factor_first) {
  const Matrix3<double> scale = diagonal<double>({2, 3, 4});
  const Vec3<double> v = (m * scale) * Vec3<double>{1, 1, 1};
  const Vec3<double> expected = m * Vec3<double>{2, 3, 4};
  EXPECT_EQ(v, expected);
}

TEST(Matrix3, determinant_of_a_product_is_the_product_of_determinants) {
  EXPECT_NEAR(determinant(m * transpose(m)), determinant(m) * determinant(m), 1e-12);
}

}  // namespace
}  // namespace scotopic

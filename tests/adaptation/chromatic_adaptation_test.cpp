#include "adaptation/chromatic_adaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace scotopic {
namespace {

// XYZ of chromaticities, Y = 1.
Vec3<double> white(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }
const Vec3<double> sodium = white(0.5266, 0.4133);  // high-pressure, about 2000 K

TEST(ChromaticAdaptation, degrees_are_those_of_the_formula) {
  // By hand, to 6 digits.
  const struct {
    double adaptation, surround, degree;
  } rows[] = {{0.01, average_surround, 0.824052}, {1, average_surround, 0.825935},
              {100, average_surround, 0.940656},  {0.01, dark_surround, 0.659241},
              {1, dark_surround, 0.660748},       {100, dark_surround, 0.752525}};
  for (const auto& row : rows)
    EXPECT_NEAR(adaptation_degree(row.adaptation, row.surround), row.degree, 1e-6) << row.adaptation;
  EXPECT_EQ(adaptation_degree(1e9), 1);
}

TEST(ChromaticAdaptation, the_lamps_white_goes_as_far_as_the_degree_says) {
  for (const double degree : {0.0, 0.3, 0.824, 1.0}) {
    const Vec3<double> seen = adapt_to_lamp(sodium, degree) * sodium;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(seen[i], degree * adapted_white[i] + (1 - degree) * sodium[i], 1e-14) << degree << " " << i;
  }
}

TEST(ChromaticAdaptation, does_not_depend_on_the_scale_of_the_lamp) {
  const Matrix3<double> one = adapt_to_lamp(sodium, 0.8);
  const Matrix3<double> hundred = adapt_to_lamp({100 * sodium[0], 100 * sodium[1], 100 * sodium[2]}, 0.8);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(one[i][j], hundred[i][j], 1e-15);
}

TEST(ChromaticAdaptation, is_the_identity_without_a_degree_or_a_colour) {
  EXPECT_EQ(adapt_to_lamp(sodium, 0).rows, identity3<double>().rows);
  EXPECT_EQ(adapt_to_lamp(white(0.3127, 0.3290), 1).rows, identity3<double>().rows);
}

TEST(ChromaticAdaptation, is_cat16_of_rational_arithmetic) {
  // Illuminant A, degree 0.8; worked out in fractions from CAT16's six decimals.
  constexpr Matrix3<double> expected{{{{0.960544695458, -0.149927860372, 0.210297187166},
                                       {-0.020536027888, 1.025850774507, -0.009250942452},
                                       {-0.002193310432, 0.072796746361, 2.450551653101}}}};
  const Matrix3<double> m = adapt_to_lamp({1.09850, 1, 0.35585}, 0.8);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(m[i][j], expected[i][j], 1e-12) << i << j;
}

TEST(ChromaticAdaptation, colours_beyond_the_spectrum_give_finite_matrices) {
  for (const Vec3<double>& lamp : {Vec3<double>{0, 1, 0}, Vec3<double>{5, 1, 0}, Vec3<double>{0.5, 1, 90}}) {
    const Matrix3<double> m = adapt_to_lamp(lamp, 1);
    for (const auto& row : m.rows)
      for (const double x : row) EXPECT_TRUE(std::isfinite(x));
  }
}

}  // namespace
}  // namespace scotopic

#include "color/primaries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

double worst_difference(const Matrix3<double>& a, const Matrix3<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) worst = std::max(worst, std::abs(a[i][j] - b[i][j]));
  return worst;
}

TEST(Primaries, rec709_is_the_matrix_of_iec_61966_2_1) {
  // IEC 61966-2-1, equation 7, four digits.
  const Matrix3<double> standard{{{{.4124, .3576, .1805}, {.2126, .7152, .0722}, {.0193, .1192, .9505}}}};
  EXPECT_LE(worst_difference(gamut_xyz_matrix("rec709").value(), standard), 5e-5);
}

TEST(Primaries, ap0_unadapted_is_the_matrix_of_st_2065_1) {
  // SMPTE ST 2065-1, annex; ten digits.
  const Matrix3<double> standard{
      {{{.9525523959, 0, .0000936786}, {.3439664498, .7281660966, -.0721325464}, {0, 0, 1.0088251844}}}};
  for (const NamedPrimaries& set : known_primaries())
    if (set.name == "ap0") {
      EXPECT_LE(worst_difference(xyz_from_rgb(set.primaries), standard), 1e-9);
    }
}

TEST(Primaries, white_of_every_gamut_is_d65_of_luminance_one) {
  for (const NamedPrimaries& set : known_primaries()) {
    const Vec3<double> white = xyz_d65_from_rgb(set.primaries) * Vec3<double>{1, 1, 1};
    EXPECT_NEAR(white[0], .3127 / .3290, 1e-14) << set.name;
    EXPECT_NEAR(white[1], 1.0, 4e-16) << set.name;
    EXPECT_NEAR(white[2], (1 - .3127 - .3290) / .3290, 1e-14) << set.name;
  }
}

TEST(Primaries, every_known_set_is_recognised_and_none_is_taken_for_another) {
  for (const NamedPrimaries& set : known_primaries()) {
    ASSERT_NE(match_matrix(xyz_d65_from_rgb(set.primaries)), nullptr);
    EXPECT_EQ(match_matrix(xyz_d65_from_rgb(set.primaries))->name, set.name);
    ASSERT_NE(match_primaries(set.primaries), nullptr);
    EXPECT_EQ(match_primaries(set.primaries)->name, set.name);
  }
  EXPECT_EQ(match_matrix(identity3<double>()), nullptr);
  EXPECT_EQ(match_primaries({{.63, .34}, {.31, .595}, {.155, .07}, {.3127, .3290}}), nullptr);  // SMPTE C
}

TEST(Primaries, unknown_gamut_has_no_matrix) { EXPECT_FALSE(gamut_xyz_matrix("rec601").has_value()); }

}  // namespace
}  // namespace scotopic

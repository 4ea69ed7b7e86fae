#include "stages/shared/colour_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace scotopic {
namespace {

struct Pair {
  Lab a, b;
  double difference;
};

// Sharma, Wu & Dalal, "The CIEDE2000 Color-Difference Formula", Color Res. Appl. 30 (2005), table 1.
const Pair published[] = {
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0010}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0012}, 7.2195},
    {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0010, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

Vec3<double> times(double s, const Vec3<double>& v) { return {s * v[0], s * v[1], s * v[2]}; }

TEST(ColourDifference, the_published_pairs_come_out_to_the_digits_printed) {
  double worst = 0;
  for (const Pair& p : published) {
    const double error = std::abs(ciede2000(p.a, p.b) - p.difference);
    worst = std::max(worst, error);
    EXPECT_LE(error, 5.1e-5) << p.difference;
    EXPECT_NEAR(ciede2000(p.b, p.a), ciede2000(p.a, p.b), 1e-12);
  }
  std::printf("worst of %zu pairs %.2g\n", std::size(published), worst);
}

TEST(ColourDifference, lab_of_white_and_of_black_and_of_grey) {
  const Lab white = lab_from_xyz(d65_white);
  EXPECT_NEAR(white.lightness, 100, 1e-12);
  EXPECT_NEAR(std::hypot(white.a, white.b), 0, 1e-12);
  EXPECT_NEAR(lab_from_xyz({0, 0, 0}).lightness, 0, 1e-12);
  // The mid-grey that pixels are exposed to has L* = 50 (CIE 015, cube root of .184186).
  EXPECT_NEAR(lab_from_xyz(times(exposed_luminance, d65_white)).lightness, 50, 0.03);
}

TEST(ColourDifference, exposure_makes_dark_pixels_count_like_bright_ones) {
  const Vec3<double> a = {0.3, 0.4, 0.2}, b = {0.33, 0.4, 0.25};
  const double at_1 = exposed_difference(a, b);
  EXPECT_GT(at_1, 1);
  for (const double scale : {1e-30, 1e-300, 1e-6, 1e6})
    EXPECT_NEAR(exposed_difference(times(scale, a), times(scale, b)), at_1, 1e-9);
}

TEST(ColourDifference, colours_without_luminance_are_compared_too) {
  EXPECT_EQ(exposed_difference({0, 0, 0}, {0, 0, 0}), 0);
  EXPECT_GT(exposed_difference({0, 0, 0}, {1e-9, 1e-9, 1e-9}), 10);
  EXPECT_GT(exposed_difference({1e-9, 1e-9, 1e-9}, {0, 0, 0}), 10);
  EXPECT_TRUE(std::isfinite(exposed_difference({0.1, -0.1, 0.9}, {0.1, 0.1, 0.9})));
  EXPECT_EQ(exposed_difference({0.1, -0.1, 0.9}, {0.1, -0.1, 0.9}), 0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exposed_difference({nan, 1, 1}, {nan, 1, 1}), 0);
  EXPECT_EQ(exposed_difference({inf, 1, 1}, {inf, 1, 1}), 0);
  EXPECT_EQ(exposed_difference({inf, 1, 1}, {-inf, 1, 1}), inf);
  EXPECT_EQ(exposed_difference({1, 1, 1}, {nan, 1, 1}), inf);
}

}  // namespace
}  // namespace scotopic

#include "stages/acuity/cutoff.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace scotopic {
namespace {

struct Row {
  double adaptation, cutoff;
};

// Ward Larson, Rushmeier and Piatko 1997, Eq. 12, worked out by hand to 4 digits.
TEST(Acuity, cutoff_follows_shlaer_as_fitted_by_ward_larson) {
  double worst = 0.0;
  for (const Row& row :
       {Row{0.001, 3.007}, Row{0.01, 5.310}, Row{0.1, 11.75}, Row{1.0, 31.53}, Row{100.0, 47.51}}) {
    const double error = std::abs(acuity_cutoff(row.adaptation) / row.cutoff - 1.0);
    worst = std::max(worst, error);
    EXPECT_LT(error, 1e-3) << "La " << row.adaptation << ": " << acuity_cutoff(row.adaptation);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(Acuity, cutoff_never_falls_as_light_grows_and_is_positive_in_the_dark) {
  double before = acuity_cutoff(0.0);
  EXPECT_GT(before, 1.0);
  EXPECT_EQ(before, acuity_cutoff(1e-5));
  EXPECT_EQ(before, acuity_cutoff(std::numeric_limits<double>::quiet_NaN()));
  for (double la = 1e-6; la < 1e6; la *= 1.1) {
    EXPECT_GE(acuity_cutoff(la), before) << la;
    before = acuity_cutoff(la);
  }
}

TEST(Acuity, gaussian_of_sigma_halves_the_cutoff_frequency) {
  for (double la : {0.0005, 0.01, 0.3, 20.0}) {
    const double ppd = 60.0, sigma = acuity_sigma_pixels(la, ppd);
    const double per_pixel = acuity_cutoff(la) / ppd;  // cycles per pixel
    const double angle = 2.0 * std::numbers::pi * per_pixel * sigma;
    EXPECT_NEAR(std::exp(-0.5 * angle * angle), 0.5, 1e-12) << la;
  }
  EXPECT_NEAR(acuity_sigma_pixels(0.01, 60.0), 0.1874 / 5.310 * 60.0, 1e-3);
}

TEST(Acuity, angular_resolution_from_field_of_view) {
  // 2 tan(45 degrees) spans the picture: the middle pixel covers 2/width.
  EXPECT_NEAR(pixels_per_degree(2000.0, 90.0), 1000.0 * std::numbers::pi / 180.0, 1e-9);
  EXPECT_TRUE(acuity_is_not_limiting(1.0, 60.0));   // 30 cycles per degree, 31.5 resolved
  EXPECT_FALSE(acuity_is_not_limiting(0.1, 60.0));  // 11.7 resolved
}

}  // namespace
}  // namespace scotopic

// The contrast sensitivity function, thresholds and Kulikowski's rule, and whether a scene calls for them.
#include "stages/contrast/sensitivity.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>
#include <vector>

namespace scotopic::contrast {
namespace {

// Expected values: the published formulas in double, by another program.
TEST(Sensitivity, is_that_of_hdr_vdp_2) {
  const struct {
    double frequency, luminance, expected;
  } cases[] = {{2, 0.01, 1.038246}, {2, 0.1, 4.724815},  {2, 1, 15.519979},
               {2, 10, 28.671690},  {2, 100, 28.441221}, {8, 1, 1.858179}};
  for (const auto& c : cases)
    EXPECT_NEAR(contrast_sensitivity(c.frequency, c.luminance), c.expected, 1e-6)
        << c.frequency << " " << c.luminance;
  EXPECT_NEAR(optical_transfer(0), 1.0, 1e-8);
}

TEST(Sensitivity, shape_is_held_beyond_what_was_measured) {
  // Below 0.002 and above 150 cd/m2 only the joint sensitivity goes on, which is one factor for all
  // frequencies.
  for (const auto& [a, b] : {std::pair{1e-4, 0.002}, {150.0, 1e4}}) {
    const double ratio = contrast_sensitivity(2, a) / contrast_sensitivity(2, b);
    EXPECT_NEAR(contrast_sensitivity(9, a) / contrast_sensitivity(9, b), ratio, 1e-12 * ratio);
  }
}

TEST(Sensitivity, thresholds_are_logarithmic_contrasts) {
  EXPECT_NEAR(threshold_contrast(4, 0.01), 0.146809, 1e-6);
  EXPECT_NEAR(threshold_contrast(4, 0.1), 0.030229, 1e-6);
  EXPECT_NEAR(threshold_contrast(4, 100), 0.002011, 1e-6);
  EXPECT_NEAR(threshold_contrast(30, 0.001), 1.0, 1e-3) << "the limit where nothing is seen";
}

TEST(Sensitivity, contrast_kept_is_equally_far_above_threshold) {
  const struct {
    double frequency, luminance, contrast, expected;
  } cases[] = {{4, 0.01, 0.2, 0.276006}, {4, 0.01, 0.5, 0.710403}, {4, 0.1, 0.05, 0.435639},
               {4, 0.1, 0.2, 0.858910},  {8, 1, 0.1, 0.768279},    {2, 1, 0.1, 0.985217}};
  for (const auto& c : cases) {
    const double excess = threshold_contrast(c.frequency, c.luminance) - threshold_contrast(c.frequency, 100);
    EXPECT_NEAR(kept_share(c.contrast, excess), c.expected, 1e-6);
  }
  EXPECT_EQ(kept_share(0.2, -0.1), 1.0) << "never more than there was";
  EXPECT_EQ(kept_share(0.0005, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(kept_share(0.1, 0.4), 0.01);
}

TEST(Sensitivity, a_display_as_bright_as_the_scene_takes_nothing) {
  for (double frequency : {2.0, 8.0, 30.0, 200.0})
    for (double light : {1e-4, 0.1, 50.0})
      EXPECT_NEAR(threshold_excess(frequency, 1e-12, light, {1.0, 1e4}), 0.0, 1e-9)
          << frequency << " " << light;
}

TEST(Sensitivity, bands_are_octaves_down_to_2_cycles_per_degree) {
  EXPECT_EQ(band_frequencies(64), (std::vector<double>{16, 8, 4, 2}));
  EXPECT_EQ(band_frequencies(20), (std::vector<double>{5, 2.5}));
  EXPECT_EQ(band_frequencies(8), (std::vector<double>{2}));
  EXPECT_TRUE(band_frequencies(7.99).empty());
}

TEST(Sensitivity, a_scene_calls_for_it_where_thresholds_differ) {
  const struct {
    double adaptation, pixels_per_degree;
    bool needed;
  } cases[] = {{0.1, 16, true}, {1, 16, false},    {3, 32, true},
               {10, 32, false}, {100, 120, false}, {0.001, 7, false}};
  for (const auto& c : cases) {
    const ContrastNeed need = contrast_need(c.adaptation, c.pixels_per_degree, 100);
    EXPECT_EQ(need.needed, c.needed) << c.adaptation << " cd/m2, " << c.pixels_per_degree << ": "
                                     << need.excess;
    EXPECT_GT(std::strlen(need.reason), 10u);
  }
}

// No pixel's surround is darker than La, so that the number is a bound on what any pixel can lose.
TEST(Sensitivity, need_is_a_bound_for_every_pixel) {
  for (double adaptation : {0.001, 0.01, 0.1, 1.0})
    for (double ppd : {16.0, 40.0, 64.0}) {
      const ContrastNeed need = contrast_need(adaptation, ppd, 100);
      for (double rho : band_frequencies(ppd))
        for (double light = 1e-5; light < 1e4; light *= 1.3)
          for (double scale : {1.0, 30.0, 1e3})
            EXPECT_LE(threshold_excess(rho, adaptation, light, {scale, 100}), need.excess + 2e-4);
    }
}

}  // namespace
}  // namespace scotopic::contrast

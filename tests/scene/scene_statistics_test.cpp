#include "scene/scene_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "receptors/receptor_space.h"
#include "support/primaries.h"

namespace scotopic {
namespace {

AppearanceParameters rec709() {
  AppearanceParameters p;
  p.xyz_from_rgb = test::rec709;
  return p;
}

struct Picture {
  std::vector<float> r, g, b;
  PixelRows rows(std::size_t from, std::size_t count) {
    return {r.data() + from, g.data() + from, b.data() + from, nullptr, nullptr, nullptr, nullptr, count};
  }
};

Picture noise(std::size_t n) {
  std::mt19937 random(1);
  std::lognormal_distribution<float> light(-3, 2);
  Picture p{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  for (std::size_t i = 0; i < n; ++i) p.r[i] = light(random), p.g[i] = light(random), p.b[i] = light(random);
  return p;
}

TEST(SceneStatistics, grey_of_one_value_is_adapted_to_that_value) {
  Picture grey{{0.2f, 0.2f}, {0.2f, 0.2f}, {0.2f, 0.2f}};
  SceneStatistics s;
  SceneMeter(rec709(), 2).measure(grey.rows(0, 2), 0, s);
  EXPECT_NEAR(s.log_mean_luminance(), 0.2 * (1 + 1e-6), 1e-7);
  EXPECT_NEAR(s.mean_photopic(), 0.2, 1e-7);
  EXPECT_NEAR(s.sp_ratio(), sp_ratio_d65, 5e-4);  // white of x = .3127, y = .3290
  EXPECT_LE(s.sp_deviation, 2e-7);
}

TEST(SceneStatistics, rows_may_be_measured_in_any_grouping) {
  Picture picture = noise(5000);
  const SceneMeter meter(rec709(), 5000);
  SceneStatistics whole, joined;
  meter.measure(picture.rows(0, 5000), 0, whole);
  for (std::size_t from = 0; from < 5000; from += 700) {
    SceneStatistics part;
    meter.measure(picture.rows(from, std::min<std::size_t>(700, 5000 - from)), from, part);
    joined.add(part);
  }
  EXPECT_EQ(whole.log_mean_luminance(), joined.log_mean_luminance());
  EXPECT_EQ(whole.mean_scotopic(), joined.mean_scotopic());
  EXPECT_EQ(whole.least, joined.least);
  EXPECT_EQ(whole.greatest, joined.greatest);
  EXPECT_EQ(whole.samples, joined.samples);
}

TEST(SceneStatistics, pixels_that_are_not_finite_enter_no_number_and_are_counted) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Picture picture{
      {0.1f, nan, inf, 0.1f, 5, 5, 5}, {0.1f, 1, 1, 0.1f, 5, 5, 5}, {0.1f, 1, -inf, 0.1f, 5, 5, 5}};
  std::vector<float> rod = {0.1f, 0.1f, 0.1f, 0.1f, nan, inf, 0.1f},
                     cone = {0.1f, 0.1f, 0.1f, 0.1f, 5, 5, -inf};
  PixelRows rows = picture.rows(0, 7);
  rows.rod = rod.data(), rows.cone_m = cone.data();
  SceneStatistics s, sound;
  SceneMeter(rec709(), 7).measure(rows, 40, s);
  EXPECT_EQ(s.non_finite, 5u);
  EXPECT_EQ(s.finite(), 2u);
  EXPECT_NEAR(s.mean_photopic(), 0.1, 1e-7);
  EXPECT_LE(s.greatest, 0.11f);
  EXPECT_LT(s.sp_deviation, 10);
  Picture two{{0.1f, 0.1f}, {0.1f, 0.1f}, {0.1f, 0.1f}};
  rows = two.rows(0, 2);
  rows.rod = rod.data();
  SceneMeter(rec709(), 7).measure(rows, 40, sound);
  EXPECT_EQ(s.mean_scotopic(), sound.mean_scotopic());
}

TEST(SceneStatistics,
     finite_pixels_whose_luminance_is_not_a_float_enter_no_number_but_are_not_called_infinite) {
  Picture picture{{3e38f, 0.1f}, {3e38f, 0.1f}, {3e38f, 0.1f}};
  SceneStatistics s;
  auto p = rec709();
  for (double& x : p.xyz_from_rgb[1]) x *= 2;
  SceneMeter(p, 2).measure(picture.rows(0, 2), 0, s);
  EXPECT_EQ(s.non_finite, 0u);
  EXPECT_EQ(s.finite(), 1u);
}

TEST(SceneStatistics, signals_beyond_a_float_count_as_the_greatest) {
  // Luminance is finite, the rods' estimate is not a float any more.
  Picture picture{{-3e38f, 0}, {3e38f, 0}, {3.3e38f, 0}};
  SceneStatistics s;
  SceneMeter(rec709(), 2).measure(picture.rows(0, 2), 0, s);
  EXPECT_EQ(s.finite(), 2u);
  EXPECT_TRUE(std::isfinite(s.scotopic.sum()));
  LuminanceHistogram h;
  h.add(std::numeric_limits<float>::infinity());
  h.add(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(h.count(), 2u);
  EXPECT_EQ(h.dark(), 1u);
}

TEST(SceneStatistics, rod_planes_are_believed_before_colour) {
  Picture grey{{0.2f}, {0.2f}, {0.2f}};
  PixelRows rows = grey.rows(0, 1);
  const float rod = static_cast<float>(0.2 * 0.645 * rod_signal_per_scotopic_luminance());  // sodium light
  rows.rod = &rod;
  SceneStatistics s;
  SceneMeter(rec709(), 1).measure(rows, 0, s);
  EXPECT_NEAR(s.sp_ratio(), 0.645, 1e-5);
  EXPECT_NEAR(s.sp_deviation, 1 - 0.645 / sp_ratio_d65, 1e-4);
}

TEST(SceneStatistics, an_empty_or_black_picture_has_no_adaptation) {
  EXPECT_EQ(SceneStatistics().log_mean_luminance(), 0);
  Picture black{{0, 0}, {0, 0}, {0, 0}};
  SceneStatistics s;
  SceneMeter(rec709(), 2).measure(black.rows(0, 2), 0, s);
  EXPECT_EQ(s.log_mean_luminance(), 0);
  EXPECT_EQ(s.finite(), 2u);
}

TEST(SceneStatistics, samples_come_from_all_over_and_are_few) {
  Picture picture = noise(100000);
  SceneStatistics s;
  SceneMeter(rec709(), 100000).measure(picture.rows(0, 100000), 0, s);
  EXPECT_GT(s.samples.size(), 3 * scene_samples / 2);
  EXPECT_LT(s.samples.size(), 3 * scene_samples * 2);
}

}  // namespace
}  // namespace scotopic

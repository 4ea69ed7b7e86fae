#include "stages/shared/luminance_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace scotopic {
namespace {

std::vector<float> night(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::lognormal_distribution<float> light(-3, 2);
  std::vector<float> values(n);
  for (float& v : values) v = random() % 20 == 0 ? 0.f : light(random);
  return values;
}

TEST(LuminanceHistogram, sum_is_that_of_the_values) {
  LuminanceHistogram h;
  long double exact = 0;
  for (const float v : night(100000, 1)) {
    h.add(v);
    exact += v;
  }
  EXPECT_NEAR(h.sum(), static_cast<double>(exact), 1e-12 * static_cast<double>(exact));
  EXPECT_EQ(h.count(), 100000u);
}

TEST(LuminanceHistogram, mean_log_keeps_its_stated_bound) {
  const auto values = night(100000, 2);
  LuminanceHistogram h;
  for (const float v : values) h.add(v);
  for (const double offset : {1e-9, 1e-4, 1e-2}) {
    long double exact = 0;
    for (const float v : values) exact += std::log(static_cast<long double>(v) + offset);
    exact /= 100000;
    std::printf("mean_log: error %.3g\n", h.mean_log(offset) - static_cast<double>(exact));
    EXPECT_NEAR(h.mean_log(offset), static_cast<double>(exact), 4e-5);
  }
}

TEST(LuminanceHistogram, a_picture_of_one_value_has_that_mean) {
  for (const float v : {0.18f, 1e-30f, 1e-42f, 3e38f}) {
    LuminanceHistogram h;
    for (int i = 0; i < 1000; ++i) h.add(v);
    EXPECT_NEAR(h.mean_log(1e-60), std::log(static_cast<double>(v)), 1e-12);
    EXPECT_NEAR(h.quantile(0.5), v, 1e-12 * static_cast<double>(v));
  }
}

TEST(LuminanceHistogram, order_and_partition_do_not_matter) {
  auto values = night(20000, 3);
  LuminanceHistogram whole;
  for (const float v : values) whole.add(v);
  std::shuffle(values.begin(), values.end(), std::mt19937(4));
  LuminanceHistogram parts[3], joined;
  for (std::size_t i = 0; i < values.size(); ++i) parts[i % 3].add(values[i]);
  for (const int i : {2, 0, 1}) joined.add(parts[i]);
  EXPECT_EQ(whole.sum(), joined.sum());
  EXPECT_EQ(whole.mean_log(1e-6), joined.mean_log(1e-6));
}

TEST(LuminanceHistogram, quantiles_and_shares_agree_with_sorting_to_one_bin) {
  auto values = night(9999, 5);
  LuminanceHistogram h;
  for (const float v : values) h.add(v);
  std::sort(values.begin(), values.end());
  for (const double q : {0.1, 0.5, 0.9, 1.0}) {
    const float exact = values[static_cast<std::size_t>(std::ceil(q * 9999)) - 1];
    EXPECT_NEAR(h.quantile(q), exact, 0.032 * exact);
  }
  const auto above = std::count_if(values.begin(), values.end(), [](float v) { return v >= 0.1f; });
  EXPECT_NEAR(h.share_from(0.1), static_cast<double>(above) / 9999, 0.01);
}

TEST(LuminanceHistogram, nothing_and_darkness_are_no_division_by_zero) {
  LuminanceHistogram h;
  EXPECT_TRUE(std::isnan(h.mean_log(1e-6)));
  EXPECT_EQ(h.share_from(1), 0);
  h.add(0.f);
  h.add(-1.f);
  h.add(-0.f);
  EXPECT_EQ(h.dark(), 3u);
  EXPECT_EQ(h.quantile(0.5), 0);
  EXPECT_EQ(h.mean_log(1e-6), std::log(1e-6));
}

TEST(LuminanceHistogram, octaves_hold_every_positive_value_once) {
  LuminanceHistogram h;
  for (const float v : {0.5f, 0.99f, 1.f, 1.99f, 2.f, 1e-30f, 1e30f}) h.add(v);
  EXPECT_EQ(h.octaves(-2, 5), (std::vector<std::uint64_t>{1, 2, 2, 1, 1}));
}

}  // namespace
}  // namespace scotopic

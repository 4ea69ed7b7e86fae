// Durand & Dorsey's base layer: the bilateral mean of log luminance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "stages/display/local/display.h"
#include "stages/display/local/picture.h"

namespace scotopic::test {
namespace {

DisplayParameters base_parameters(double sigma) {
  DisplayParameters p;
  p.adaptation = 0.1;
  p.white_luminance = 2.0;
  p.sigma = sigma;
  p.xyz_from_rgb = p.xyz_from_gamut = rec709;
  return p;
}

/// Value of a pixel of a hash, 0 to 1.
double noise(int x, int y) {
  unsigned h = static_cast<unsigned>(x) * 374761393u + static_cast<unsigned>(y) * 668265263u;
  h = (h ^ (h >> 13)) * 1274126177u;
  return (h ^ (h >> 16)) / 4294967296.0;
}

TEST(BaseLayer, a_constant_picture_is_its_own) {
  for (const double value : {1e-5, 0.18, 3e4}) {
    const Planes out =
        filtered(BaseLayer(base_parameters(4)), Planes(40, 30, [&](int, int) { return value; }));
    for (const float base : out.r) EXPECT_NEAR(static_cast<double>(base), value, 3e-5 * value);
  }
}

TEST(BaseLayer, is_the_bilateral_mean_of_log_luminance_by_its_definition) {
  // Two lit fields and a dark one, 30 % texture on each, and a lamp.
  const int width = 96, height = 64;
  const Planes in(width, height, [](int x, int y) {
    const double field = x < 40 ? 0.02 : y < 30 ? 1.0 : 40.0;
    return (x - 60) * (x - 60) + (y - 20) * (y - 20) < 9 ? 2000.0 : field * (0.7 + 0.6 * noise(x, y));
  });
  const double sigma = 5, range = 0.4;
  const Planes out = filtered(BaseLayer(base_parameters(sigma)), in);
  double worst = 0, square = 0;
  const auto log_at = [&](int x, int y) { return std::log10(static_cast<double>(in.r[in.at(x, y)])); };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0, weights = 0;
      for (int v = std::max(0, y - 18); v < std::min(height, y + 19); ++v)
        for (int u = std::max(0, x - 18); u < std::min(width, x + 19); ++u) {
          const double d2 = (u - x) * (u - x) + (v - y) * (v - y), dl = log_at(u, v) - log_at(x, y);
          if (d2 > 12.25 * sigma * sigma) continue;
          const double w = std::exp(-d2 / (2 * sigma * sigma) - dl * dl / (2 * range * range));
          sum += w * log_at(u, v);
          weights += w;
        }
      const double error = std::log10(static_cast<double>(out.r[out.at(x, y)])) - sum / weights;
      worst = std::max(worst, std::abs(error));
      square += error * error;
    }
  const double mean = std::sqrt(square / (width * height));
  std::printf("base layer against its definition: %.2g decades r.m.s., %.2g at worst\n", mean, worst);
  EXPECT_LE(mean, 0.004);
  EXPECT_LE(worst, 0.04);
}

TEST(BaseLayer, keeps_an_edge_of_light_and_takes_a_texture_away) {
  const Planes in(80, 40, [](int x, int y) { return (x < 40 ? 0.1 : 10.0) * (0.9 + 0.2 * noise(x, y)); });
  const Planes out = filtered(BaseLayer(base_parameters(6)), in);
  const auto decades = [&](int x) { return std::log10(static_cast<double>(out.r[out.at(x, 20)])); };
  EXPECT_NEAR(decades(39), -1.0, 0.01);
  EXPECT_NEAR(decades(40), 1.0, 0.01);
  for (int x = 10; x < 35; ++x) EXPECT_NEAR(decades(x), decades(10), 0.012);
}

TEST(BaseLayer, pixels_that_are_no_light_have_none_and_are_seen_by_none) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  const Planes clean(32, 32, [](int x, int y) { return 0.5 + 0.1 * noise(x, y); });
  const Planes before = filtered(BaseLayer(base_parameters(3)), clean);
  Planes in = clean;
  in.g[in.at(5, 5)] = nan;
  in.r[in.at(20, 9)] = infinite;
  in.b[in.at(9, 20)] = -infinite;
  in.r[in.at(25, 25)] = in.g[in.at(25, 25)] = in.b[in.at(25, 25)] = 0;
  const Planes out = filtered(BaseLayer(base_parameters(3)), in);
  for (const auto& [x, y] : {std::pair(5, 5), {20, 9}, {9, 20}, {25, 25}})
    EXPECT_EQ(out.r[out.at(x, y)], 0.0f);
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(std::isfinite(out.r[i]));
  // A hole changes a neighbour's mean as little as one pixel can; black is too far off to weigh.
  EXPECT_NEAR(static_cast<double>(out.r[out.at(6, 5)]), static_cast<double>(before.r[before.at(6, 5)]), 0.01);
  EXPECT_NEAR(static_cast<double>(out.r[out.at(26, 25)]), static_cast<double>(before.r[before.at(26, 25)]),
              0.01);
}

TEST(BaseLayer, does_not_depend_on_tiles) {
  const Planes in(150, 90,
                  [](int x, int y) { return std::exp(6 * noise(x / 9, y / 9)) * (1 + 0.2 * noise(x, y)); });
  const BaseLayer base(base_parameters(3));
  const Planes whole = filtered(base, in);
  for (const int side : {17, 64}) EXPECT_EQ(filtered(base, in, side).r, whole.r);
}

TEST(BaseLayer, its_range_leaves_out_a_hundredth_below_and_a_thousandth_above) {
  LuminanceHistogram histogram;
  for (int i = 0; i < 9; ++i) histogram.add(1e-3f);
  for (int i = 0; i < 990; ++i) histogram.add(i < 495 ? 0.5f : 4.0f);
  histogram.add(1e6f);
  const DisplayRange range = range_of(histogram, base_parameters(3));
  EXPECT_NEAR(range.low, 1.0, 0.03);
  EXPECT_NEAR(range.high, 8.0, 0.25);
  const DisplayRange none = range_of(LuminanceHistogram(), base_parameters(3));
  EXPECT_EQ(none.low, 0.1);
  EXPECT_EQ(none.high, 0.1);
}

}  // namespace
}  // namespace scotopic::test

// The pool, and the noise of a pixel, against numbers made in double apart from this code.
#include "stages/noise/rod_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "adaptation/mesopic.h"
#include "stages/acuity/cutoff.h"
#include "support/primaries.h"

namespace scotopic {
namespace {

RodNoiseParameters at(double la, double hidden = 0.1, double ppd = 200) {
  RodNoiseParameters p;
  p.eye.adaptation = la;
  p.eye.white_luminance = la / 0.18;
  p.eye.xyz_from_rgb = test::rec709;
  p.pixels_per_degree = ppd;
  p.hidden_fraction = hidden;
  return p;
}

struct Row {
  double la, cutoff, pitch, quantum, dark, events, relative, shown;
};

// 7 digits as printed; sd/S shown with hidden_fraction 0.1.
constexpr std::array<Row, 5> table = {
    {{1e-5, 1.198457, 0.266106, 6.417251e-6, 2.491704e-5, 7.7237, 0.723570, 0.695065},
     {1e-4, 1.870584, 0.170490, 1.589774e-5, 2.533804e-5, 17.0979, 0.266701, 0.242833},
     {1e-3, 3.007415, 0.106043, 4.285541e-5, 2.642477e-5, 58.1309, 0.132565, 0.085778},
     {0.01, 5.308549, 0.060076, 1.477760e-4, 2.924452e-5, 166.991, 0.077476, 0},
     {0.1, 11.751233, 0.027139, 9.065012e-4, 3.660950e-5, 271.943, 0.060649, 0}}};

double shown_variance(const RodNoiseParameters& p) {
  const RodPool pool = rod_pool(p);
  const double mean = sp_ratio_d65 * p.eye.adaptation + pool.dark;
  return std::max(0.0, mean * pool.quantum - p.hidden_fraction * p.hidden_fraction * mean * mean);
}

TEST(RodNoise, pools_are_as_the_table_has_them) {
  for (const Row& row : table) {
    const RodNoiseParameters p = at(row.la);
    const RodPool pool = rod_pool(p);
    const double s = sp_ratio_d65 * row.la;
    EXPECT_NEAR(acuity_cutoff(row.la), row.cutoff, 5.1e-7 * std::max(1.0, row.cutoff));
    EXPECT_NEAR(pool.pitch, row.pitch, 5.1e-7);
    EXPECT_NEAR(pool.quantum / row.quantum, 1, 5e-7);
    EXPECT_NEAR(pool.dark / row.dark, 1, 5e-7);
    EXPECT_NEAR((s + pool.dark) / pool.quantum / row.events, 1, 1e-5);
    EXPECT_NEAR(std::sqrt((s + pool.dark) * pool.quantum) / s, row.relative, 6e-7);
    EXPECT_NEAR(std::sqrt(shown_variance(p)) / s, row.shown, 6e-7);
  }
}

struct Noisy {
  double la, hidden;
  std::array<double, 4> at;  // n = -2, 0, 1, 2
};

TEST(RodNoise, a_pixels_light_fluctuates_as_the_vectors_say) {
  constexpr std::array<Noisy, 5> rows = {
      {{1e-3, 0, {1.844226480e-3, 2.454063009e-3, 2.791192246e-3, 3.149795465e-3}},
       {1e-4, 0, {1.275073567e-4, 2.424760763e-4, 3.119722073e-4, 3.894761858e-4}},
       {1e-5, 0, {0, 2.301684716e-5, 4.233273913e-5, 6.491093677e-5}},
       {1e-3, 0.1, {2.055610600e-3, 2.460310163e-3, 2.676129456e-3, 2.900928423e-3}},
       {1e-4, 0.1, {1.370861059e-4, 2.431648950e-4, 3.061496045e-4, 3.757645241e-4}}}};
  double worst = 0;
  for (const Noisy& row : rows)
    for (std::size_t i = 0; i < 4; ++i) {
      const double n = std::array{-2.0, 0.0, 1.0, 2.0}[i];
      const double got = noisy_scotopic(at(row.la, row.hidden), sp_ratio_d65 * row.la, n);
      worst = std::max(worst, std::abs(got - row.at[i]) / (sp_ratio_d65 * row.la));
    }
  std::printf("S' against the vectors: worst %.2g of S\n", worst);
  EXPECT_LE(worst, 1e-9);
  EXPECT_NEAR(shown_variance(at(1e-3, 0)) / 1.06762464e-7, 1, 1e-8);
  EXPECT_NEAR(shown_variance(at(1e-4, 0)) / 4.32129202e-9, 1, 1e-8);
  EXPECT_NEAR(shown_variance(at(1e-3)) / 4.47004561e-8, 1, 1e-8);
}

TEST(RodNoise, normal_numbers_give_the_mean_and_variance_asked_for) {
  const RodNoiseParameters p = at(1e-3);
  const double s = sp_ratio_d65 * 1e-3;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double sum = 0, squares = 0;
  constexpr int count = 400000;
  for (int i = 0; i < count; ++i) {
    const double d = noisy_scotopic(p, s, normal(random)) - s;
    sum += d;
    squares += d * d;
  }
  const double sd = std::sqrt(shown_variance(p));
  EXPECT_NEAR(sum / count / sd, 0, 5 / std::sqrt(count));
  EXPECT_NEAR(squares / count / (sd * sd), 1, 5 * std::sqrt(2.5 / count));
}

NoisePixel grey(const RodNoiseParameters& p, double y) {
  return {{y, y, y}, y * OperatorConstants(p.eye).rod_white, p.eye.adaptation + y * p.eye.white_luminance};
}

TEST(RodNoise, a_grey_takes_on_the_fluctuation_of_its_rods) {
  const RodNoiseParameters p = at(1e-4);
  const double y = 0.18;  // La itself
  for (const double n : {-4.9, -2.0, 0.0, 1.0, 2.0}) {
    const Vec3<double> out = add_rod_noise(p, grey(p, y), n);
    // m = 0 here: rods alone, S'/S is Y'/Y.
    const double s = sp_ratio_d65 * 1e-4;
    for (const double c : out) EXPECT_NEAR(c, y * noisy_scotopic(p, s, n) / s, 1e-15);
  }
}

TEST(RodNoise, lifts_by_white_and_dims_at_constant_chromaticity) {
  const RodNoiseParameters p = at(1e-4);
  NoisePixel pixel = grey(p, 0.2);
  pixel.rgb = {0.3, 0.2, 0.05};
  const Vec3<double> up = add_rod_noise(p, pixel, 1.5), down = add_rod_noise(p, pixel, -1.5);
  EXPECT_GT(up[0] - 0.3, 0);
  EXPECT_NEAR(up[0] - 0.3, up[2] - 0.05, 1e-16);
  EXPECT_NEAR(up[0] - 0.3, up[1] - 0.2, 1e-16);
  EXPECT_LT(down[0], 0.3);
  EXPECT_NEAR(down[0] / 0.3, down[2] / 0.05, 1e-15);
  for (const double n : {-4.9, -3.0}) {
    const Vec3<double> darkest = add_rod_noise(at(1e-5), {{0.01, 0.01, 0.01}, 0.005, 1e-5}, n);
    for (const double c : darkest) EXPECT_GE(c, 0);
  }
}

TEST(RodNoise, is_not_called_for_from_0_003_up_and_then_changes_no_bit) {
  EXPECT_TRUE(rod_noise_need(at(0.00297)).needed);
  EXPECT_FALSE(rod_noise_need(at(0.00298)).needed);
  double low = 1e-3, high = 1e-2;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (rod_noise_need(at(middle)).needed ? low : high) = middle;
  }
  EXPECT_NEAR(low, 0.0029756, 5e-8);
  const RodNoiseParameters p = at(high * (1 + 1e-9));
  for (double y = 1e-6; y < 1e4; y *= 1.3)
    for (const double rods : {0.05, 1.0, 4.0}) {
      NoisePixel pixel = grey(p, y);
      pixel.rod *= rods;
      for (const double n : {-4.9, 1.0, 4.9}) EXPECT_EQ(add_rod_noise(p, pixel, n), pixel.rgb) << y;
    }
}

TEST(RodNoise, lamps_do_not_flicker) {
  const RodNoiseParameters p = at(1e-4);
  const NoisePixel lamp = grey(p, 5 / p.eye.white_luminance);
  EXPECT_EQ(add_rod_noise(p, lamp, 4.0), lamp.rgb);
}

TEST(RodNoise, strength_exposure_and_bleaching_scale_as_they_should) {
  const RodNoiseParameters p = at(1e-4);
  const NoisePixel pixel = grey(p, 0.2);
  const double full = add_rod_noise(p, pixel, 1)[0] - 0.2;
  RodNoiseParameters half = p, dimmed = p, bleached = p;
  half.strength = 0.5;
  EXPECT_NEAR(add_rod_noise(half, pixel, 1)[0] - 0.2, full / 2, 1e-15);
  dimmed.exposure = 0.25;
  EXPECT_NEAR(add_rod_noise(dimmed, pixel, 1)[0] - 0.2, full / 4, 1e-15);
  bleached.bleach_light = 1e-3;
  EXPECT_NEAR(rod_pool(bleached).dark, rod_pool(p).dark + sp_ratio_d65 * 1e-3, 1e-18);
  RodNoiseParameters off = p;
  off.strength = 0;
  EXPECT_FALSE(rod_noise_need(off).needed);
}

TEST(RodNoise, what_is_no_light_passes) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const RodNoiseParameters p = at(1e-4);
  for (const double bad : {inf, -inf, nan, 0x1p121}) {
    NoisePixel pixel = grey(p, 0.2);
    pixel.rgb[1] = bad;
    const Vec3<double> out = add_rod_noise(p, pixel, 2);
    EXPECT_EQ(out[0], 0.2);
    EXPECT_EQ(std::isnan(out[1]), std::isnan(bad));
  }
  NoisePixel black = grey(p, 0);
  EXPECT_GE(add_rod_noise(p, black, 3)[0], 0);   // dark light is seen in black, too
  EXPECT_EQ(add_rod_noise(p, black, -3)[0], 0);  // and black cannot go below
}

}  // namespace
}  // namespace scotopic

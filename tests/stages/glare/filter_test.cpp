// What the filter promises of any picture: bits, sums, bounds; threads and instruction sets do not show.
#include "stages/glare/filter.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "stages/glare/judge.h"

namespace scotopic {
namespace {

using test::filtered;
using test::Picture;
using test::Plane;
using test::same_bits;
using test::square_grid;
using test::sum;

GlareParameters parameters(int width, int height, double ppd = 20, GlareRule rule = GlareRule::above) {
  return {{}, square_grid(width, height, ppd), rule, 1};
}

/// Dark ground with noise, `lamps` coloured lamps of up to 10^decades.
Picture night(int width, int height, int lamps, double decades = 4, unsigned seed = 1) {
  Picture out(width, height);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (Plane& plane : out.planes)
    for (float& x : plane.values) x = static_cast<float>(0.001 + 0.1 * unit(random));
  for (int i = 0; i < lamps; ++i) {
    const int x = static_cast<int>(unit(random) * width), y = static_cast<int>(unit(random) * height);
    const double level = std::pow(10, decades * unit(random));
    for (Plane& plane : out.planes) plane(x, y) = static_cast<float>(level * (0.2 + unit(random)));
  }
  return out;
}

TEST(GlareFilter, flat_pictures_keep_their_bits) {
  for (const GlareRule rule : {GlareRule::above, GlareRule::all})
    for (const float value : {0.0f, 0.3f, 1.7f, 3e20f, -2.0f}) {
      Picture picture(77, 53, value);
      picture.planes[1] = Plane(77, 53, 0.7f * value);
      EXPECT_TRUE(same_bits(filtered(parameters(77, 53, 20, rule), picture), picture)) << value;
      picture.planes[2](5, 6) = std::numeric_limits<float>::quiet_NaN();
      EXPECT_TRUE(same_bits(filtered(parameters(77, 53, 20, rule), picture), picture))
          << value << " with a NaN";
    }
}

TEST(GlareFilter, nothing_above_the_threshold_keeps_its_bits) {
  Picture picture = night(77, 53, 0);
  picture.planes[0](3, 3) = 1;  // at, not above
  picture.planes[1](9, 9) = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(same_bits(filtered(parameters(77, 53), picture), picture));
}

TEST(GlareFilter, strength_0_keeps_bits_and_half_is_half_way) {
  const Picture picture = night(77, 53, 10);
  GlareParameters p = parameters(77, 53);
  const Picture whole = filtered(p, picture);
  p.grid.strength = 0;
  EXPECT_TRUE(same_bits(filtered(p, picture), picture));
  p.grid.strength = 0.5;
  const Picture half = filtered(p, picture);
  for (std::size_t i = 0; i < picture.planes[0].values.size(); ++i) {
    const double a = double{picture.planes[0].values[i]}, b = double{whole.planes[0].values[i]};
    EXPECT_NEAR(double{half.planes[0].values[i]}, (a + b) / 2, 1e-6 * std::max(a, b)) << i;
  }
}

TEST(GlareFilter, light_is_conserved) {
  for (const auto& [w, h] : {std::pair{77, 53}, {300, 290}, {20, 10}, {1, 100}, {2, 2}})
    for (const GlareRule rule : {GlareRule::above, GlareRule::all}) {
      const Picture in = night(w, h, 8);
      const Picture out = filtered(parameters(w, h, 20, rule), in);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(sum(out.planes[k]) / sum(in.planes[k]), 1, 3e-7) << w << "x" << h << " plane " << k;
      EXPECT_FALSE(same_bits(in, out)) << w << "x" << h;
    }
}

TEST(GlareFilter, light_is_conserved_in_a_panorama) {
  for (const int width : {160, 250, 301}) {
    GlareParameters p = parameters(width, width / 2);
    p.grid = {width, width / 2, width / 360.0, width / 360.0, GlareSides::meet, 1};
    const Picture in = night(width, width / 2, 8);
    const Picture out = filtered(p, in);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sum(out.planes[k]) / sum(in.planes[k]), 1, 3e-7) << width;
  }
}

TEST(GlareFilter, no_border_is_dark) {
  // Half of it lit, to the borders: the rim of the lit half loses to the dark half only, as the middle does.
  Picture picture(100, 60, 1.5f);
  for (Plane& plane : picture.planes)
    for (int y = 0; y < 60; ++y)
      for (int x = 50; x < 100; ++x) plane(x, y) = 1000;
  const Picture out = filtered(parameters(100, 60), picture);
  for (int y = 0; y < 60; ++y) {
    EXPECT_GT(out.planes[0](99, y), 0.98f * out.planes[0](90, y));
    EXPECT_GE(out.planes[0](0, y), 1.5f);
  }
  EXPECT_NEAR(double{out.planes[0](80, 0) / out.planes[0](80, 30)}, 1, 0.02);
}

TEST(GlareFilter, values_stay_between_those_of_the_picture) {
  for (const GlareRule rule : {GlareRule::above, GlareRule::all}) {
    const Picture in = night(150, 90, 30, 8);
    const Picture out = filtered(parameters(150, 90, 20, rule), in);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax_element(in.planes[k].values.begin(), in.planes[k].values.end());
      for (const float x : out.planes[k].values) {
        EXPECT_GE(x, *least);
        EXPECT_LE(x, *most);
      }
    }
  }
}

TEST(GlareFilter, what_is_not_finite_passes_and_is_seen_by_nobody) {
  Picture in = night(90, 70, 6);
  const float odd[] = {std::nanf(""), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity(), 1e37f};
  for (int i = 0; i < 4; ++i) in.planes[static_cast<std::size_t>(i) % 3](20 + 9 * i, 30) = odd[i];
  const Picture out = filtered(parameters(90, 70), in);
  Picture lit = in;
  for (int i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(30 * 90 + 20 + 9 * i);
      EXPECT_EQ(std::memcmp(&out.planes[k].values[at], &in.planes[k].values[at], sizeof(float)), 0) << i;
      // With another value in its place, not finite either, everything else is the same.
      lit.planes[k].values[at] = std::nanf("");
    }
  const Picture other = filtered(parameters(90, 70), lit);
  for (std::size_t i = 0; i < out.planes[0].values.size(); ++i) {
    if (std::isnan(lit.planes[0].values[i])) continue;
    EXPECT_EQ(out.planes[0].values[i], other.planes[0].values[i]) << i;
    EXPECT_GE(out.planes[0].values[i], std::min(in.planes[0].values[i], 1.0f)) << "darker at " << i;
  }
}

TEST(GlareFilter, ten_decades_in_one_picture_keep_six_digits) {
  Picture in = night(120, 90, 0);
  for (Plane& plane : in.planes)
    for (float& x : plane.values) x *= 1e-6f;
  for (Plane& plane : in.planes) plane(60, 45) = 1e4f;
  GlareParameters p = parameters(120, 90);
  // A second way to the same: the lamp alone, by the exact function within 3 %; the ground is under it
  // untouched.
  const Picture out = filtered(p, in);
  for (const auto& [x, y] : {std::pair{61, 45}, {80, 50}, {0, 0}, {119, 89}}) {
    const double veil = test::exact_weight(GlareFunction({}), p.grid, x - 60, y - 45) * (1e4 - 1);
    EXPECT_NEAR((double{out.planes[0](x, y)} - double{in.planes[0](x, y)}) / veil, 1, 0.03) << x << " " << y;
  }
  EXPECT_NEAR(sum(out.planes[0]) / sum(in.planes[0]), 1, 3e-7);
}

TEST(GlareFilter, hue_of_the_lamp_is_that_of_its_glow) {
  Picture in(90, 70);
  const float lamp[3] = {500, 250, 20};
  for (std::size_t k = 0; k < 3; ++k) in.planes[k](45, 35) = lamp[k];
  const Picture out = filtered(parameters(90, 70), in);
  for (const auto& [x, y] : {std::pair{46, 35}, {60, 40}, {0, 0}}) {
    EXPECT_NEAR(double{out.planes[1](x, y) / out.planes[0](x, y)}, 0.5, 1e-6);
    EXPECT_NEAR(double{out.planes[2](x, y) / out.planes[0](x, y)}, 0.04, 1e-6);
  }
}

TEST(GlareFilter, other_planes_scatter_by_the_share_that_rgb_decides) {
  Picture rgb = night(90, 70, 12);
  Picture lms = rgb;
  Plane rods(90, 70);
  for (std::size_t i = 0; i < rods.values.size(); ++i) {
    lms.planes[0].values[i] = 0.5f * rgb.planes[0].values[i] + 0.25f * rgb.planes[1].values[i];
    rods.values[i] = 0.25f * rgb.planes[1].values[i];
  }
  GlarePicture view = lms.view();
  for (std::size_t k = 0; k < 3; ++k) view.rgb[k] = rgb.planes[k].values.data();
  view.light.push_back(rods.values.data());
  const Picture before = rgb;
  GlareFilter(parameters(90, 70)).apply(view);
  EXPECT_TRUE(same_bits(rgb, before));
  const Picture out = filtered(parameters(90, 70), rgb);
  for (std::size_t i = 0; i < rods.values.size(); ++i) {
    const double l = 0.5 * double{out.planes[0].values[i]} + 0.25 * double{out.planes[1].values[i]};
    EXPECT_NEAR(double{lms.planes[0].values[i]} / l, 1, 2e-6) << i;
    EXPECT_NEAR(double{rods.values[i]} / (0.25 * double{out.planes[1].values[i]}), 1, 2e-6) << i;
  }
}

TEST(GlareFilter, threads_do_not_show) {
  Picture in = night(211, 420, 40);
  for (const bool hole : {false, true}) {
    if (hole) in.planes[0](100, 128) = std::nanf("");
    const Picture one = filtered(parameters(211, 420), in);
    for (const int n : {2, 5})
      EXPECT_TRUE(same_bits(one, filtered(parameters(211, 420), in, test::threads(n)))) << n;
    const ParallelFor backwards = [](int count, const std::function<void(int)>& task) {
      for (int i = count; i-- > 0;) task(i);
    };
    EXPECT_TRUE(same_bits(one, filtered(parameters(211, 420), in, backwards)));
  }
}

TEST(GlareFilter, instruction_sets_do_not_show) {
  Picture in = night(211, 150, 40);
  in.planes[0](100, 128) = std::nanf("");
  GlareParameters odd = parameters(211, 150);
  odd.grid.ppd_x = 13;
  const auto choose = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  };
  for (const GlareParameters& p : {parameters(211, 150), parameters(211, 150, 20, GlareRule::all), odd}) {
    choose(0);
    const Picture best = filtered(p, in);
    int sets = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1, ++sets) {
      choose(left & -left);
      EXPECT_TRUE(same_bits(best, filtered(p, in))) << hwy::TargetName(left & -left);
    }
    choose(0);
    EXPECT_GE(sets, 1);
  }
}

// Where nothing near is lit the filter leaves rungs out; the bare pyramid does not.
TEST(GlareFilter, what_is_left_out_would_have_been_zero) {
  for (const GlareSides sides : {GlareSides::end, GlareSides::meet})
    for (const double ppd_x : {8.0, 16.0}) {
      GlareParameters p = parameters(320, 150);
      p.grid = {320, 150, ppd_x, 8, sides, 1};
      Picture in(320, 150);
      const std::pair<int, int> lamps[] = {{0, 0},     {319, 2},  {63, 127}, {64, 40},  {126, 128},
                                           {192, 149}, {255, 75}, {256, 90}, {257, 104}};
      for (Plane& plane : in.planes)
        for (const auto& [x, y] : lamps) plane(x, y) = 1000;
      Plane excess = in.planes[0];
      for (float& x : excess.values) x = std::max(0.0f, x - 1);
      const GlareFunction function({});
      const Plane come = test::convolved(function, p.grid, excess);
      const Picture out = filtered(p, in);
      for (std::size_t i = 0; i < come.values.size(); ++i)
        if (excess.values[i] == 0) {
          EXPECT_EQ(out.planes[1].values[i], come.values[i]) << i % 320 << " " << i / 320;
        }
    }
}

TEST(GlareFilter, rows_may_have_gaps_that_are_left_alone) {
  const Picture in = night(61, 40, 9);
  Picture wide(70, 40, 7777);
  for (std::size_t k = 0; k < 3; ++k)
    for (int y = 0; y < 40; ++y)
      std::copy_n(&in.planes[k].values[static_cast<std::size_t>(y) * 61], 61, &wide.planes[k](0, y));
  GlareFilter(parameters(61, 40)).apply(wide.view());
  const Picture out = filtered(parameters(61, 40), in);
  for (std::size_t k = 0; k < 3; ++k)
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 70; ++x) EXPECT_EQ(wide.planes[k](x, y), x < 61 ? out.planes[k](x, y) : 7777.0f);
}

TEST(GlareFilter, memory_is_planned) {
  // 8K, three planes: below the program's limit of 4 GiB with the picture itself.
  const GlareFilter filter(parameters(7680, 4320, 192));
  const double per_pixel = static_cast<double>(filter.bytes(3, 2)) / (7680.0 * 4320.0);
  std::printf("  8K, three planes: %.1f bytes a pixel, %.0f MB\n", per_pixel, per_pixel * 7680 * 4320 / 1e6);
  EXPECT_GT(per_pixel, 10);
  EXPECT_LT(per_pixel, 16);
}

TEST(GlareFilter, refuses_what_is_outside_its_domain) {
  GlareParameters p = parameters(10, 10);
  p.threshold = 0;
  EXPECT_THROW(GlareFilter{p}, std::invalid_argument);
  p = parameters(10, 10);
  p.grid.strength = 1.1;
  EXPECT_THROW(GlareFilter{p}, std::invalid_argument);
  Picture picture(10, 10);
  GlarePicture view = picture.view();
  view.light.clear();
  EXPECT_THROW(GlareFilter(parameters(10, 10)).apply(view), std::invalid_argument);
  view = picture.view();
  view.rgb[1] = nullptr;
  EXPECT_THROW(GlareFilter(parameters(10, 10)).apply(view), std::invalid_argument);
}

}  // namespace
}  // namespace scotopic

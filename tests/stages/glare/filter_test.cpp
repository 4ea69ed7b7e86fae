// What the filter promises of any picture: bits, sums, bounds; threads and instruction sets do not show.
#include "stages/glare/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "stages/glare/judge.h"

namespace scotopic {
namespace {

using test::filtered;
using test::night;
using test::parameters;
using test::Picture;
using test::Plane;
using test::same_bits;
using test::square_grid;
using test::sum;

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

TEST(GlareFilter, a_flat_plane_keeps_its_bits_beside_others) {
  for (const float value : {-2.3f, 0.7f, 3e-7f}) {
    Picture in = night(77, 53, 8);
    in.planes[2] = Plane(77, 53, value);
    const Picture out = filtered(parameters(77, 53, 20, GlareRule::all), in);
    EXPECT_EQ(out.planes[2].values, in.planes[2].values) << value;
    EXPECT_NE(out.planes[0].values, in.planes[0].values) << value;
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

// A rung reaches further than once around it.
TEST(GlareFilter, light_is_conserved_in_a_panorama_of_few_pixels) {
  for (const int width : {5, 12})
    for (int x = 0; x < width; ++x) {
      GlareParameters p = parameters(width, 9);
      p.grid.sides = GlareSides::meet;
      Picture in(width, 9);
      in.planes[1](x, 4) = 1000;
      EXPECT_NEAR(sum(filtered(p, in).planes[1]) / 1000, 1, 3e-7) << width << " " << x;
    }
}

// At most: of a pixel whose picture goes on without end. Of a panorama, whose sides meet, its middle rows
// come near.
TEST(GlareFilter, no_pixel_loses_more_than_it_says) {
  const GlareGrid grids[] = {test::square_grid(77, 53, 20),
                             test::square_grid(300, 290, 3),
                             test::square_grid(20, 20, 0.5),
                             {256, 128, 256 / 360.0, 256 / 360.0, GlareSides::meet, 1}};
  for (const GlareGrid& grid : grids) {
    const Plane sums = test::convolved(GlareFunction({}), grid, Plane(grid.width, grid.height, 1));
    const double most = GlareFilter({{}, grid, GlareRule::all, 1}).most_lost();
    const double found = double{*std::max_element(sums.values.begin(), sums.values.end())};
    std::printf("  %d x %d: most %.5f, found %.5f\n", grid.width, grid.height, most, found);
    EXPECT_GE(most, found * (1 - 1e-6)) << grid.width;
    EXPECT_LE(most, 1.2 * found) << grid.width;
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

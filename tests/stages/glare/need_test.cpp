// Where glare is said not to be called for, computing it all the same changes nothing that is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "stages/glare/judge.h"

namespace scotopic {
namespace {

using test::Picture;
using test::Plane;

constexpr std::array<double, 3> weights = {0.2126, 0.7152, 0.0722};

double luminance(const Picture& p, std::size_t i) {
  return weights[0] * double{p.planes[0].values[i]} + weights[1] * double{p.planes[1].values[i]} +
         weights[2] * double{p.planes[2].values[i]};
}

GlareParameters need_parameters(int width, int height, double ppd, double halo = 0) {
  return {{28.58, 0.5, halo}, test::square_grid(width, height, ppd), GlareRule::above, 1};
}

Picture scene(std::mt19937& random, int width, int height, double ground, double decades) {
  std::uniform_real_distribution<double> unit(0, 1);
  Picture out(width, height);
  for (Plane& plane : out.planes)
    for (float& x : plane.values) x = static_cast<float>(ground * (0.2 + 0.8 * unit(random)));
  const int lamps = 1 + static_cast<int>(6 * unit(random));
  for (int i = 0; i < lamps; ++i) {
    const int x = static_cast<int>(unit(random) * width), y = static_cast<int>(unit(random) * height);
    const double level = 1 + std::pow(10, decades * unit(random) - 4);
    for (Plane& plane : out.planes) plane(x, y) = static_cast<float>(level * (0.5 + 0.5 * unit(random)));
  }
  return out;
}

// 200 with light above the threshold, and those without that come up among them.
void bounds_the_rise_of_every_pixel_on_200_scenes(double halo) {
  std::mt19937 random(4);
  int skipped = 0, above = 0;
  double nearest = 0, largest = 0;
  for (int n = 0; above < 200; ++n) {
    const int width = 40 + static_cast<int>(random() % 160), height = 40 + static_cast<int>(random() % 100);
    const double ppd = 3 + static_cast<double>(random() % 60);
    const Picture in = scene(random, width, height, n % 2 == 0 ? 0.9 : 0.05, n % 3 == 0 ? 5 : 3);
    Picture out = in;
    const GlareFilter filter(need_parameters(width, height, ppd, halo));
    const GlareNeed need = filter.need(out.view(), weights);
    filter.apply(out.view());
    above += need.above > 0;
    skipped += !need.called_for && need.above > 0;
    double rise = 0;
    for (std::size_t i = 0; i < in.planes[0].values.size(); ++i) {
      const double before = luminance(in, i), after = luminance(out, i);
      rise = std::max(rise, (after - before) / (before + 0.001));
      // What the display cannot show still cannot be shown.
      const auto v = [i](const Picture& p) {
        return std::max({p.planes[0].values[i], p.planes[1].values[i], p.planes[2].values[i]});
      };
      if (v(in) > 1) {
        EXPECT_GE(v(out), 1 - 1e-6f) << n;
      }
    }
    if (need.above == 0) {
      EXPECT_EQ(rise, 0);
      continue;
    }
    if (!need.called_for) {
      EXPECT_LE(rise, need.veil) << "scene " << n << ": " << need.reason;
      nearest = std::max(nearest, rise / need.veil);
      largest = std::max(largest, rise);
    }
  }
  std::printf(
      "  %d of %d scenes with light above the threshold skipped; largest rise %.5f, %.2f of its bound\n",
      skipped, above, largest, nearest);
  EXPECT_GT(skipped, 20);
  EXPECT_LT(skipped, above);
  EXPECT_LE(largest, 0.01);
}

TEST(GlareNeed, bounds_the_rise_of_every_pixel_on_200_scenes) {
  bounds_the_rise_of_every_pixel_on_200_scenes(0);
}
TEST(GlareNeed, bounds_it_with_a_halo_too) { bounds_the_rise_of_every_pixel_on_200_scenes(0.033); }

// The last column of blocks is one pixel wide: around it the neighbour's pixels are near.
TEST(GlareNeed, bounds_the_rise_across_the_sides_of_a_panorama) {
  GlareParameters p = need_parameters(161, 80, 161 / 360.0);
  p.grid.sides = GlareSides::meet;
  const GlareFilter filter(p);
  int skipped = 0, called_for = 0;
  for (double excess = 1e-6; excess < 1; excess *= 1.3) {
    Picture in(161, 80, 0.9f);
    for (Plane& plane : in.planes) {
      plane(0, 40) = static_cast<float>(1 + excess);
      for (int x = 144; x < 160; ++x) plane(x, 40) = 0;
    }
    Picture out = in;
    const GlareNeed need = filter.need(out.view(), weights);
    filter.apply(out.view());
    (need.called_for ? called_for : skipped)++;
    for (std::size_t i = 0; !need.called_for && i < in.planes[0].values.size(); ++i) {
      const double before = luminance(in, i);
      EXPECT_LE((luminance(out, i) - before) / (before + 0.001), need.veil) << excess << " at " << i % 161;
    }
  }
  EXPECT_GT(skipped, 0);
  EXPECT_GT(called_for, 0);
}

TEST(GlareNeed, says_how_many_pixels_and_why) {
  Picture picture(100, 80, 0.5f);
  const GlareFilter filter(need_parameters(100, 80, 20));
  EXPECT_FALSE(filter.need(picture.view(), weights).called_for);
  for (int k = 0; k < 3; ++k) picture.planes[static_cast<std::size_t>(k)](20 + k, 20) = 1;  // at, not above
  EXPECT_EQ(filter.need(picture.view(), weights).reason, "no pixel is above 1");
  for (int x = 10; x < 17; ++x) picture.planes[2](x, 40) = 1000;
  picture.planes[0](3, 3) = std::numeric_limits<float>::infinity();
  const GlareNeed need = filter.need(picture.view(), weights);
  EXPECT_TRUE(need.called_for);
  EXPECT_EQ(need.above, 7);
  EXPECT_GT(need.veil, 0.01);
}

TEST(GlareNeed, is_the_same_where_the_rows_greatest_components_are_known) {
  std::mt19937 random(8);
  for (int n = 0; n < 40; ++n) {
    Picture picture = scene(random, 93, 70, n % 2 == 0 ? 0.9 : 0.05, 4);
    if (n % 3 == 0) picture.planes[1](40, 30) = std::nanf("");
    if (n % 5 == 0) picture.planes[2](50, 31) = std::numeric_limits<float>::infinity();
    const GlareFilter filter(need_parameters(93, 70, 20));
    GlarePicture view = picture.view();
    const GlareNeed read = filter.need(view, weights);
    std::vector<float> greatest;
    for (std::ptrdiff_t y = 0; y < 70; ++y)
      greatest.push_back(
          greatest_component({view.rgb[0] + 93 * y, view.rgb[1] + 93 * y, view.rgb[2] + 93 * y}, 93));
    view.greatest = greatest.data();
    const GlareNeed known = filter.need(view, weights);
    EXPECT_EQ(read.called_for, known.called_for) << n;
    EXPECT_EQ(read.above, known.above) << n;
    EXPECT_EQ(read.veil, known.veil) << n;
  }
}

TEST(GlareNeed, a_row_s_greatest_component_is_that_of_its_finite_pixels) {
  for (int width = 1; width < 70; ++width)
    for (int at = 0; at < width; ++at) {
      std::vector<float> r(static_cast<std::size_t>(width), -1.0f), g = r, b = r;
      EXPECT_EQ(greatest_component({r.data(), g.data(), b.data()}, width), 0);
      g[static_cast<std::size_t>(at)] = 3;
      b[static_cast<std::size_t>((at + 1) % width)] = std::numeric_limits<float>::infinity();
      r[static_cast<std::size_t>((at + 2) % width)] = std::nanf("");
      EXPECT_EQ(greatest_component({r.data(), g.data(), b.data()}, width), 3) << width << " " << at;
    }
}

TEST(GlareNeed, all_is_called_for_unless_the_picture_is_nearly_flat) {
  GlareParameters p = need_parameters(64, 64, 20);
  p.rule = GlareRule::all;
  Picture picture(64, 64, 0.5f);
  const GlareFilter filter(p);
  EXPECT_FALSE(filter.need(picture.view(), weights).called_for);
  picture.planes[1](3, 3) = 0.504f;
  const GlareNeed slight = filter.need(picture.view(), weights);
  EXPECT_FALSE(slight.called_for);
  EXPECT_NEAR(slight.veil, filter.most_lost() * 0.008, 1e-4);
  picture.planes[1](3, 3) = 0.6f;
  EXPECT_TRUE(filter.need(picture.view(), weights).called_for);
  EXPECT_LT(filter.most_lost(), 0.98);
}

TEST(GlareNeed, threads_do_not_show) {
  std::mt19937 random(9);
  Picture picture = scene(random, 300, 200, 0.9, 3);
  const GlareFilter filter(need_parameters(300, 200, 30));
  const GlareNeed one = filter.need(picture.view(), weights),
                  five = filter.need(picture.view(), weights, test::threads(5));
  EXPECT_EQ(one.veil, five.veil);
  EXPECT_EQ(one.above, five.above);
}

}  // namespace
}  // namespace scotopic

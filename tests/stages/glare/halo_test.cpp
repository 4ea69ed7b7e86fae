// The lens's halo: the function, the ring that the pyramid draws of it, and the filter's promises with it.
#include "stages/glare/halo.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "stages/glare/judge.h"

namespace scotopic {
namespace {

using test::filtered;
using test::Picture;
using test::Plane;
using test::same_bits;
using test::sum;
using test::Worst;

constexpr double share = 0.033;
constexpr double radians = std::numbers::pi / 180;

GlareParameters halo_parameters(int width, int height, double ppd, GlareRule rule = GlareRule::all) {
  return {{28.58, 0.5, share}, test::square_grid(width, height, ppd), rule, 1};
}

Picture lamp(int width, int height, int x, int y, float light = 1) {
  Picture out(width, height);
  for (Plane& plane : out.planes) plane(x, y) = light;
  return out;
}

Picture lamps(int width, int height) {
  Picture out(width, height, 0.01f);
  for (int i = 0; i < 30; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      out.planes[k](i * 37 % width, i * 53 % height) = static_cast<float>(1 + i * i * (k + 1));
  return out;
}

TEST(GlareHalo, is_a_ring_of_3_degrees_that_holds_all_its_light) {
  for (const double wavelength : {442.0, 465.0, 550.0, 568.0, 610.0}) {
    double light = 0;
    for (double theta = 0.0005; theta < 6; theta += 0.001)
      light += halo_psf(theta, wavelength) * std::sin(theta * radians) * 0.001 * radians;
    EXPECT_NEAR(2 * std::numbers::pi * light, 1, 1e-3) << wavelength;
    EXPECT_NEAR(halo_psf(halo_radius(wavelength) + halo_sigma, wavelength) /
                    halo_psf(halo_radius(wavelength), wavelength),
                std::exp(-0.5), 1e-7);
  }
  EXPECT_EQ(halo_radius(568), 3);
  // By mpmath: 2 pi times the integral of f3 sin(theta) at 568 nm.
  EXPECT_NEAR(share * halo_psf(3, 568), 14.4177, 1e-4);
}

TEST(GlareHalo, is_seen_by_wide_pupils) {
  const double cases[][2] = {{2, 0}, {3, 0}, {5, 0.0165}, {7, 0.033}, {8, 0.033}};
  for (const auto& [pupil, expected] : cases) EXPECT_NEAR(halo_share(pupil), expected, 1e-15) << pupil;
}

/// The ring over a pixel's square, 1/sr, by the midpoint rule.
double over_pixel(const GlareGrid& grid, int dx, int dy, double wavelength) {
  constexpr int steps = 8;
  double out = 0;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i)
      out += halo_psf(std::hypot((dx - 0.5 + (i + 0.5) / steps) / grid.ppd_x,
                                 (dy - 0.5 + (j + 0.5) / steps) / grid.ppd_y),
                      wavelength);
  return out / (steps * steps);
}

/// Largest difference of a drawn ring from the function, of its peak; 2 to 4.5 degrees from a lamp at (x, y).
Worst worst_of(const GlareGrid& grid, std::size_t plane, int x, int y) {
  GlareParameters with = {{28.58, 0.5, share}, grid, GlareRule::all, 1}, without = with;
  without.eye.halo = 0;
  const Picture in = lamp(grid.width, grid.height, x, y);
  const Picture ring = filtered(with, in), none = filtered(without, in);
  const double wavelength = halo_wavelengths[plane];
  const double scale = share * radians * radians / (grid.ppd_x * grid.ppd_y);
  const double peak = halo_psf(halo_radius(wavelength), wavelength);
  Worst worst;
  for (int dy = 0; y + dy < grid.height; ++dy)
    for (int dx = 0; x + dx < grid.width; ++dx) {
      const double theta = std::hypot(dx / grid.ppd_x, dy / grid.ppd_y);
      if (theta < 2 || theta > 4.5) continue;
      const double drawn = double{ring.planes[plane](x + dx, y + dy)} -
                           (1 - share) * double{none.planes[plane](x + dx, y + dy)};
      const double error = (drawn / scale - over_pixel(grid, dx, dy, wavelength)) / peak;
      if (std::abs(error) > std::abs(worst.error)) worst = {error, dx, dy};
    }
  return worst;
}

TEST(GlareHalo, is_drawn_as_the_function_has_it) {
  const struct {
    double ppd_x, ppd_y, bound;
  } cases[] = {{14, 14, 0.04},  {21.5, 21.5, 0.015}, {32, 32, 0.015}, {42.5, 42.5, 0.015},
               {60, 60, 0.015}, {24, 40, 0.015},     {40, 24, 0.015}};
  for (const auto& c : cases)
    for (const std::size_t plane : {0u, 1u, 2u}) {
      const int w = static_cast<int>(5 * c.ppd_x), h = static_cast<int>(5 * c.ppd_y);
      // A little off the levels' samples, in the middle and in a corner.
      for (const auto& [x, y] : {std::pair{5, 3}, std::pair{w + 1, h + 3}}) {
        const GlareGrid grid = {x + w, y + h, c.ppd_x, c.ppd_y, GlareSides::end, 1};
        const Worst worst = worst_of(grid, plane, x, y);
        std::printf("  %.1f x %.1f, %.0f nm, from (%d, %d): worst %+.4f of the ring's peak at (%d, %d)\n",
                    c.ppd_x, c.ppd_y, halo_wavelengths[plane], x, y, worst.error, worst.dx, worst.dy);
        EXPECT_LT(std::abs(worst.error), c.bound);
      }
    }
}

TEST(GlareHalo, is_red_outside_and_blue_inside) {
  const Picture out = filtered(halo_parameters(401, 61, 40), lamp(401, 61, 200, 30));
  const auto brightest = [&](std::size_t k) {
    int best = 80;
    for (int d = 80; d < 180; ++d)
      if (out.planes[k](200 + d, 30) > out.planes[k](200 + best, 30)) best = d;
    return best / 40.0;
  };
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(brightest(k), halo_radius(halo_wavelengths[k]), 0.05) << k;
}

TEST(GlareHalo, takes_its_light_from_the_lamp) {
  for (const auto& [w, h] : {std::pair{260, 240}, {77, 53}, {30, 20}, {1, 300}})
    for (const GlareRule rule : {GlareRule::above, GlareRule::all}) {
      const Picture in = lamps(w, h), out = filtered(halo_parameters(w, h, 32, rule), in);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(sum(out.planes[k]) / sum(in.planes[k]), 1, 4e-7) << w << "x" << h << " plane " << k;
    }
  GlareParameters p = halo_parameters(512, 256, 512 / 360.0);
  p.grid.sides = GlareSides::meet;
  const Picture in = lamps(512, 256), out = filtered(p, in);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sum(out.planes[k]) / sum(in.planes[k]), 1, 4e-7);
}

TEST(GlareHalo, goes_around_a_panorama) {
  GlareParameters p = halo_parameters(1024, 64, 20);
  p.grid.sides = GlareSides::meet;
  const Picture out = filtered(p, lamp(1024, 64, 0, 32));  // on a sample of every level
  for (int d = 1; d < 100; ++d)
    EXPECT_NEAR(double{out.planes[1](1024 - d, 32) / out.planes[1](d, 32)}, 1, 1e-5) << d;
}

TEST(GlareHalo, leaves_flat_pictures_their_bits) {
  for (const float value : {0.3f, 1.7f, 3e20f}) {
    Picture picture(177, 153, value);
    EXPECT_TRUE(same_bits(filtered(halo_parameters(177, 153, 30), picture), picture)) << value;
    picture.planes[2](5, 6) = std::nanf("");
    EXPECT_TRUE(same_bits(filtered(halo_parameters(177, 153, 30), picture), picture))
        << value << " with a NaN";
  }
}

TEST(GlareHalo, weighs_both_ways_alike) {
  const GlareParameters p = halo_parameters(250, 200, 32);
  for (int i = 0; i < 8; ++i) {
    const int ax = i * 37 % 250, ay = i * 11 % 200, bx = (ax + 90) % 250, by = (ay + 30) % 200;
    const Picture there = filtered(p, lamp(250, 200, ax, ay)), back = filtered(p, lamp(250, 200, bx, by));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(double{there.planes[k](bx, by) / back.planes[k](ax, ay)}, 1, 1e-5) << i;
  }
}

TEST(GlareHalo, what_is_not_finite_neither_spreads_nor_darkens) {
  Picture in(250, 200, 1.5f);
  for (Plane& plane : in.planes)
    for (int y = 0; y < 200; ++y)
      for (int x = 125; x < 250; ++x) plane(x, y) = 1000;
  const Picture whole = filtered(halo_parameters(250, 200, 32), in);
  in.planes[1](180, 100) = std::nanf("");
  const Picture out = filtered(halo_parameters(250, 200, 32), in);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 250; ++x) {
      if (x == 180 && y == 100) continue;
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(double{out.planes[k](x, y) / whole.planes[k](x, y)}, 1, 0.02)
            << k << " " << x << " " << y;
    }
}

TEST(GlareHalo, threads_and_instruction_sets_do_not_show) {
  const Picture in = lamps(211, 420);
  const GlareParameters p = halo_parameters(211, 420, 24, GlareRule::above);
  const Picture one = filtered(p, in);
  for (const int n : {2, 5}) EXPECT_TRUE(same_bits(one, filtered(p, in, test::threads(n)))) << n;
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    EXPECT_TRUE(same_bits(one, filtered(p, in))) << hwy::TargetName(left & -left);
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
}

TEST(GlareHalo, refuses_more_light_than_there_is) {
  EXPECT_THROW(GlareFunction({28.58, 0.5, 1}), std::invalid_argument);
  EXPECT_THROW(GlareFunction({28.58, 0.5, -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace scotopic

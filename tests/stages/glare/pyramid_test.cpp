// The pyramid against the function integrated over pixels; symmetric, smooth, and no weight negative.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "stages/glare/judge.h"

namespace scotopic {
namespace {

using test::convolved;
using test::exact_weight;
using test::Plane;
using test::square_grid;
using test::Worst;

Plane point(int width, int height, int x, int y) {
  Plane out(width, height);
  out(x, y) = 1;
  return out;
}

TEST(GlarePyramid, weights_are_these) {
  // 129 x 97 pixels at 20 a degree, one lit in the middle. `exact` by mpmath's quadrature over the pixel
  // (a coarser rule has (1, 0) at 4.2238e-2 and the next two 5e-4 and 2e-4 too small).
  const GlareFunction function({});
  const GlareGrid grid = square_grid(129, 97, 20);
  const Plane out = convolved(function, grid, point(129, 97, 64, 48));
  const struct {
    int dx, dy;
    double exact, pyramid;
  } cases[] = {{1, 0, 4.22602641e-2, 4.173822e-2},  {1, 1, 2.11502849e-2, 2.128627e-2},
               {2, 0, 9.1084809e-3, 9.066535e-3},   {5, 0, 7.3399316e-4, 7.289090e-4},
               {10, 10, 3.7682886e-5, 3.815785e-5}, {40, 0, 2.1872075e-6, 2.167556e-6},
               {64, 48, 3.7651732e-7, 3.740403e-7}};
  for (const auto& c : cases) {
    const auto got = double{out(64 + c.dx, 48 + c.dy)};
    EXPECT_NEAR(exact_weight(function, grid, c.dx, c.dy) / c.exact, 1, 2e-8) << c.dx << " " << c.dy;
    EXPECT_NEAR(got / c.pyramid, 1, 0.01) << c.dx << " " << c.dy;
    EXPECT_NEAR(got / c.exact, 1, 0.03) << c.dx << " " << c.dy;
  }
}

TEST(GlarePyramid, light_that_leaves_a_pixel_is_that_of_the_function) {
  const GlareFunction function({});
  const GlareGrid grid = square_grid(129, 97, 20);
  const Plane sums = convolved(function, grid, Plane(129, 97, 1));
  EXPECT_NEAR(double{sums(64, 48) - convolved(function, grid, point(129, 97, 64, 48))(64, 48)}, 0.564913,
              0.0030);
  EXPECT_NEAR(double{sums(0, 0) - convolved(function, grid, point(129, 97, 0, 0))(0, 0)}, 0.201987, 0.0015);
}

// Every distance near the source, then ever larger steps, 0.05 to 60 degrees.
Worst worst_error(const GlareGrid& grid, int x, int y) {
  const GlareFunction function({});
  const Plane out = convolved(function, grid, point(grid.width, grid.height, x, y));
  Worst worst;
  const auto next = [](int d) { return d < 20 ? d + 1 : d + d / 10; };
  for (int dy = 0; y + dy < grid.height; dy = next(dy))
    for (int dx = 0; x + dx < grid.width; dx = next(dx)) {
      const double theta = std::hypot(dx / grid.ppd_x, dy / grid.ppd_y);
      if ((dx == 0 && dy == 0) || theta < 0.05 || theta > 60) continue;
      const double error = double{out(x + dx, y + dy)} / exact_weight(function, grid, dx, dy) - 1;
      if (std::abs(error) > std::abs(worst.error)) worst = {error, dx, dy};
    }
  return worst;
}

TEST(GlarePyramid, errs_by_3_percent_at_most_from_the_middle_and_from_a_corner) {
  for (const double ppd : {3.0, 10.0, 40.0})
    for (const bool corner : {false, true}) {
      const int side = static_cast<int>(ppd * (ppd > 30 ? 30 : 60) * (corner ? 1 : 2)) + 1;
      const Worst worst =
          worst_error(square_grid(side, side, ppd), corner ? 0 : side / 2, corner ? 0 : side / 2);
      std::printf("  %2.0f pixels a degree, %s: worst %+.4f at (%d, %d)\n", ppd, corner ? "corner" : "middle",
                  worst.error, worst.dx, worst.dy);
      EXPECT_LT(std::abs(worst.error), 0.03) << ppd;
    }
}

TEST(GlarePyramid, errs_no_more_where_pixels_are_not_square) {
  for (const auto& [x, y] : {std::pair{10.0, 20.0}, std::pair{20.0, 10.0}, std::pair{12.0, 17.0}}) {
    const GlareGrid grid{601, 501, x, y, GlareSides::end, 1};
    const Worst worst = worst_error(grid, 300, 250);
    std::printf("  %.0f x %.0f: worst %+.4f at (%d, %d)\n", x, y, worst.error, worst.dx, worst.dy);
    EXPECT_LT(std::abs(worst.error), 0.03) << x;
  }
}

TEST(GlarePyramid, weighs_both_ways_alike) {
  const GlareFunction function({});
  for (const auto& [w, h] : {std::pair{129, 97}, std::pair{50, 31}, std::pair{200, 3}, std::pair{1, 40}}) {
    const GlareGrid grid = square_grid(w, h, 12);
    for (int i = 0; i < 12; ++i) {
      const int ax = i * 37 % w, ay = i * 11 % h, bx = i * 53 % w, by = i * 29 % h;
      const float there = convolved(function, grid, point(w, h, ax, ay))(bx, by);
      const float back = convolved(function, grid, point(w, h, bx, by))(ax, ay);
      EXPECT_NEAR(double{there / back}, 1, 1e-6)
          << w << "x" << h << ": " << ax << "," << ay << " " << bx << "," << by;
    }
  }
}

// A ring between two octaves would be a bump in what falls off. Along eight rays no pixel is brighter than
// the one before, and the slope against the angle stays near that of the function.
TEST(GlarePyramid, has_no_rings) {
  const GlareFunction function({});
  const int side = 601, middle = 300;
  const GlareGrid grid = square_grid(side, side, 20);
  const Plane out = convolved(function, grid, point(side, side, middle, middle));
  double rise = 0, jump = 0;
  int at_step = 0;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {2, 1}, {-1, -2}})
    for (int i = 1; (i + 1) * std::max(std::abs(dx), std::abs(dy)) < middle; ++i) {
      const auto at = [&](int k) { return double{out(middle + k * dx, middle + k * dy)}; };
      const auto exact = [&](int k) { return exact_weight(function, grid, k * dx, k * dy); };
      rise = std::max(rise, at(i + 1) / at(i) - 1);
      const double beside = std::abs(at(i + 1) / at(i) / (exact(i + 1) / exact(i)) - 1);
      if (beside > jump) jump = beside, at_step = i;
    }
  std::printf("  largest step beside the function's %.4f, at step %d of a ray\n", jump, at_step);
  EXPECT_EQ(rise, 0);
  EXPECT_LT(jump, 0.035);
}

TEST(GlarePyramid, sides_of_a_panorama_meet) {
  const GlareFunction function({});
  const GlareGrid grid{256, 128, 256 / 360.0, 256 / 360.0, GlareSides::meet, 1};
  const Plane out = convolved(function, grid, point(256, 128, 1, 64));
  double worst = 0;
  for (int d = 2; d <= 53; ++d)  // to 75 degrees; the function ends at 90
    for (const int to : {(1 + d) % 256, (1 + 256 - d) % 256})
      worst = std::max(worst, std::abs(double{out(to, 64)} / exact_weight(function, grid, d, 0) - 1));
  std::printf("  around a panorama: worst %.4f\n", worst);
  EXPECT_LT(worst, 0.03);
  // Moved around by what all levels have in common, nothing changes.
  const Plane moved = convolved(function, grid, point(256, 128, 1 + 64, 64));
  for (int x = 0; x < 256; ++x) EXPECT_EQ(moved((x + 64) % 256, 70), out(x, 70)) << x;
}

// The function ends at 90 degrees; a level's Gaussian reaches a little further.
TEST(GlarePyramid, nothing_is_seen_of_a_lamp_behind) {
  const GlareFunction function({});
  const GlareGrid grid{256, 128, 256 / 360.0, 256 / 360.0, GlareSides::meet, 1};
  const Plane out = convolved(function, grid, point(256, 128, 64, 64));
  for (int x = 64 + 80; x <= 64 + 176; ++x) {
    const double veil = double{out(x, 64)} / double{out(64 + 53, 64)};
    EXPECT_LT(veil, 1e-4) << x - 64 << " pixels";
  }
}

// Against the function integrated over pixels, to 75 degrees (it ends at 90),
// from every phase of the wider samples.
TEST(GlarePyramid, sides_of_a_panorama_meet_whatever_its_width) {
  const GlareFunction function({});
  for (const int width : {101, 129, 250, 301, 333, 375, 750, 1001, 1500}) {
    const GlareGrid grid{width, width / 2, width / 360.0, width / 360.0, GlareSides::meet, 1};
    double worst = 0;
    int of_lamp = 0, at = 0;
    for (const int lamp : {0, 1, 2, 3, width / 3, width - 1}) {
      const int middle = grid.height / 2;
      const Plane out = convolved(function, grid, point(width, grid.height, lamp, middle));
      for (int d = 1; d < width * 75 / 360; d += 1 + d / 20)
        for (const int to : {(lamp + d) % width, (lamp + width - d) % width}) {
          const double error = double{out(to, middle)} / exact_weight(function, grid, d, 0) - 1;
          if (std::abs(error) > std::abs(worst)) worst = error, of_lamp = lamp, at = to;
        }
    }
    std::printf("  %d wide: worst %+.4f at %d of a lamp at %d\n", width, worst, at, of_lamp);
    EXPECT_LT(std::abs(worst), 0.03) << width;
  }
}

TEST(GlarePyramid, a_panorama_6000_wide_is_right) {
  const GlareFunction function({});
  const GlareGrid grid{6000, 200, 6000 / 360.0, 6000 / 360.0, GlareSides::meet, 1};
  const Plane out = convolved(function, grid, point(6000, 200, 5999, 100));
  double worst = 0;
  for (int d = 1; d < 1250; d += 1 + d / 30)
    for (const int to : {(5999 + d) % 6000, 5999 - d})
      worst = std::max(worst, std::abs(double{out(to, 100)} / exact_weight(function, grid, d, 0) - 1));
  std::printf("  worst %.4f\n", worst);
  EXPECT_LT(worst, 0.03);
}

TEST(GlarePyramid, an_uneven_panorama_weighs_both_ways_alike_and_evenly) {
  const GlareFunction function({});
  for (const int width : {101, 375, 750}) {
    const GlareGrid grid{width, 60, width / 360.0, width / 360.0, GlareSides::meet, 1};
    for (int i = 0; i < 8; ++i) {
      const int ax = i * 37 % width, ay = i * 11 % 60, bx = i * 53 % width, by = i * 29 % 60;
      const float there = convolved(function, grid, point(width, 60, ax, ay))(bx, by);
      const float back = convolved(function, grid, point(width, 60, bx, by))(ax, ay);
      EXPECT_NEAR(double{there}, double{back}, 1e-6 * double{back}) << width << ": " << i;
    }
    const Plane sums = convolved(function, grid, Plane(width, 60, 1));
    for (int x = 0; x < width; ++x)
      EXPECT_NEAR(double{sums(x, 30) / sums(0, 30)}, 1, 2e-5) << width << " " << x;
  }
}

TEST(GlarePyramid, refuses_grids_outside_its_domain) {
  const GlareFunction function({});
  const auto made = [&](int w, int h, double x, double y, GlareSides sides) {
    glare::Ladder(function, {w, h, x, y, sides, 1});
  };
  EXPECT_NO_THROW(made(1, 1, 20, 20, GlareSides::end));
  EXPECT_NO_THROW(made(5120, 2560, 14, 14, GlareSides::meet));
  EXPECT_NO_THROW(made(8000, 4000, 22, 22, GlareSides::meet));
  EXPECT_NO_THROW(made(6000, 3000, 16, 16, GlareSides::meet));
  EXPECT_NO_THROW(made(1, 1, 20, 20, GlareSides::meet));
  EXPECT_THROW(made(10, 10, 0, 20, GlareSides::end), std::invalid_argument);
  EXPECT_THROW(made(10, 10, 20, 41, GlareSides::end), std::invalid_argument);
  EXPECT_THROW(made(0, 10, 20, 20, GlareSides::end), std::invalid_argument);
}

}  // namespace
}  // namespace scotopic

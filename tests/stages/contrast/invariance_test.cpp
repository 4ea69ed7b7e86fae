// A pixel's result depends on the picture alone: not on tiles, windows, threads or instruction sets, by no
// bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "stages/contrast/judge.h"
#include "stages/contrast/ranges.h"
#include "support/simd_targets.h"

namespace scotopic {
namespace {

using test::Picture;

Picture night(int width, int height, bool holes) {
  Picture p(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double v = std::exp(std::sin(0.7 * x) * std::cos(1.1 * y) + 2 * std::sin(0.05 * (x + y)));
      p.grey(x, y, std::hypot(x - 60, y - 40) < 4 ? 3e3 : 0.2 * v);
      p.planes[1][p.at(x, y)] *= static_cast<float>(1.2 + std::sin(2.1 * x + y));
      if (holes && (37 * x + 91 * y) % 311 == 0) p.planes[2][p.at(x, y)] = std::nanf("");
    }
  return p;
}

ContrastParameters parameters(double pixels_per_degree) {
  ContrastParameters p;
  p.adaptation = 0.01;
  p.unit = 0.05;
  p.pixels_per_degree = pixels_per_degree;
  p.display = {200, 100};
  return p;
}

int differing(const Picture& a, const Picture& b) {
  int count = 0;
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < a.planes[k].size(); ++i)
      count += std::memcmp(&a.planes[k][i], &b.planes[k][i], sizeof(float)) != 0;
  return count;
}

/// Tile by tile, each from a copy of its window with `extra` pixels more than the halo.
Picture in_tiles(const ContrastFilter& filter, const Picture& in, int width, int height, int extra) {
  Picture out(in.width, in.height);
  const int halo = filter.halo() + extra;
  for (int y = 0; y < in.height; y += height)
    for (int x = 0; x < in.width; x += width) {
      AcuityTile tile = test::tile_of(out);
      tile.x = x;
      tile.y = y;
      tile.width = std::min(width, in.width - x);
      tile.height = std::min(height, in.height - y);
      for (float** plane : {&tile.r, &tile.g, &tile.b}) *plane += out.at(x, y);
      const int x0 = std::max(0, x - halo), x1 = std::min(in.width, x + tile.width + halo);
      const int y0 = std::max(0, y - halo), y1 = std::min(in.height, y + tile.height + halo);
      Picture cut(x1 - x0, y1 - y0);
      for (int k = 0; k < 3; ++k)
        for (int j = y0; j < y1; ++j)
          for (int i = x0; i < x1; ++i) cut.planes[k][cut.at(i - x0, j - y0)] = in.planes[k][in.at(i, j)];
      AcuityWindow window = test::window_of(cut);
      window.x = x0;
      window.y = y0;
      window.image_width = in.width;
      window.image_height = in.height;
      filter.filter(window, tile);
    }
  return out;
}

TEST(ContrastInvariance, tiles_and_windows_do_not_show) {
  for (bool holes : {false, true}) {
    const Picture in = night(215, 301, holes);
    for (double ppd : {8.0, 17.0, 40.0, 64.0}) {
      const ContrastFilter filter(parameters(ppd));
      const Picture whole = test::filtered(parameters(ppd), in);
      for (const auto& [w, h, extra] : {Vec3<int>{215, 16, 0}, Vec3<int>{37, 129, 3}, Vec3<int>{64, 64, 0},
                                        Vec3<int>{215, 301, 0}, Vec3<int>{13, 250, 1}})
        EXPECT_EQ(differing(whole, in_tiles(filter, in, w, h, extra)), 0)
            << ppd << " pixels per degree, tiles " << w << "x" << h << (holes ? ", holes" : "");
    }
  }
}

// A hole changes the way the rest is computed, and must not change its bits: far from it, where nothing of it
// is seen, the picture is as without.
TEST(ContrastInvariance, a_hole_does_not_show_from_afar) {
  const Picture clean = night(215, 100, false);
  Picture holed = clean;
  holed.planes[0][holed.at(5, 50)] = std::nanf("");
  const ContrastParameters p = parameters(40);
  const Picture a = test::filtered(p, clean), b = test::filtered(p, holed);
  const int reach = ContrastFilter(p).halo();
  for (int k = 0; k < 3; ++k)
    for (int y = 0; y < 100; ++y)
      for (int x = 6 + reach; x < 215; ++x)
        ASSERT_EQ(std::memcmp(&a.planes[k][a.at(x, y)], &b.planes[k][b.at(x, y)], 4), 0) << x << ", " << y;
}

TEST(ContrastInvariance, threads_do_not_show) {
  const Picture in = night(215, 401, true);
  const ContrastFilter filter(parameters(40));
  const ParallelFor threads = [](int count, const std::function<void(int)>& task) {
    std::atomic<int> next{0};
    std::vector<std::jthread> pool;
    for (int t = 0; t < 3; ++t)
      pool.emplace_back([&] {
        for (int i = next++; i < count; i = next++) task(i);
      });
  };
  Picture out(in.width, in.height);
  filter.filter(test::window_of(in), test::tile_of(out), threads);
  EXPECT_EQ(differing(test::filtered(parameters(40), in), out), 0);
}

TEST(ContrastInvariance, instruction_sets_do_not_show) {
  const Picture in = night(123, 97, true);
  const Picture best = test::filtered(parameters(40), in);
  test::on_every_target([&](const char* target) {
    EXPECT_EQ(differing(best, test::filtered(parameters(40), in)), 0) << target;
  });
}

TEST(ContrastInvariance, the_halo_holds_what_any_tile_needs) {
  for (int bands = 1; bands <= 5; ++bands) {
    const int halo = contrast::pyramid_halo(bands);
    for (int begin = 0; begin < 700; begin += 7)
      for (int size : {1, 2, 5, 64, 129}) {
        const contrast::Range source = contrast::axis_ranges({begin, begin + size}, 900, bands).source[0];
        EXPECT_GE(source.begin, std::max(0, begin - halo)) << bands << " " << begin << " " << size;
        EXPECT_LE(source.end, std::min(900, begin + size + halo)) << bands << " " << begin << " " << size;
      }
  }
  EXPECT_EQ(contrast::pyramid_halo(2), 31);
  EXPECT_EQ(contrast::pyramid_halo(4), 139);
}

TEST(ContrastInvariance, a_window_without_its_halo_is_refused) {
  const Picture in = night(100, 100, false);
  Picture out(100, 100);
  AcuityWindow window = test::window_of(in);
  window.image_height = 200;
  EXPECT_THROW(ContrastFilter(parameters(40)).filter(window, test::tile_of(out)), std::invalid_argument);
}

TEST(ContrastInvariance, small_pictures_work) {
  for (int width : {1, 2, 3, 17})
    for (int height : {1, 2, 5}) {
      const Picture in = night(width, height, false);
      const ContrastParameters p = parameters(64);
      const Picture out = test::filtered(p, in);
      const std::vector<double> expected = test::judged(p, in, 1);
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(static_cast<double>(out.planes[1][i]), expected[i], 0.015 * expected[i])
            << width << "x" << height;
    }
}

}  // namespace
}  // namespace scotopic

// A pixel's result depends on the image alone: not on tiles, windows, threads; and hardly on the processor.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <thread>

#include "stages/acuity/scenes.h"

namespace scotopic {
namespace {

using test::Image;

/// Filters tile by tile, each from a window cut out of the image with `extra` pixels more than the halo.
Image in_tiles(const AcuityFilter& filter, const Image& in, int tile_width, int tile_height, int extra) {
  Image out(in.width, in.height);
  const int halo = filter.halo() + extra;
  for (int y = 0; y < in.height; y += tile_height) {
    for (int x = 0; x < in.width; x += tile_width) {
      AcuityTile tile{nullptr,
                      nullptr,
                      nullptr,
                      in.width,
                      x,
                      y,
                      std::min(tile_width, in.width - x),
                      std::min(tile_height, in.height - y)};
      const int x0 = std::max(0, x - halo), x1 = std::min(in.width, x + tile.width + halo);
      const int y0 = std::max(0, y - halo), y1 = std::min(in.height, y + tile.height + halo);
      Image cut(x1 - x0, y1 - y0);
      for (int k = 0; k < 3; ++k)
        for (int j = y0; j < y1; ++j)
          for (int i = x0; i < x1; ++i) cut.planes[k][cut.at(i - x0, j - y0)] = in.planes[k][in.at(i, j)];
      AcuityWindow window = test::window_of(cut);
      window.x = x0;
      window.y = y0;
      window.image_width = in.width;
      window.image_height = in.height;
      tile.r = out.planes[0].data() + out.at(x, y);
      tile.g = out.planes[1].data() + out.at(x, y);
      tile.b = out.planes[2].data() + out.at(x, y);
      filter.filter(window, tile);
    }
  }
  return out;
}

int differing(const Image& a, const Image& b) {
  int count = 0;
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < a.planes[k].size(); ++i)
      count += std::memcmp(&a.planes[k][i], &b.planes[k][i], sizeof(float)) != 0;
  return count;
}

std::vector<AcuityParameters> engines_and_widths() {
  std::vector<AcuityParameters> ways;
  for (double sigma : {1.4, 3.7, 9.0, 25.0})
    for (AcuitySpace space : {AcuitySpace::light, AcuitySpace::lab})
      for (AcuityEngine engine : {AcuityEngine::window, AcuityEngine::cells}) {
        if (engine == AcuityEngine::window && sigma > 9.0) continue;
        ways.push_back(test::parameters(sigma));
        ways.back().space = space;
        ways.back().engine = engine;
      }
  return ways;
}

Image with_holes() {
  Image image = test::night(151, 117);
  for (int i = 0; i < 40; ++i)
    image.planes[1][image.at(static_cast<int>(151 * test::noise(i, 3, 1)),
                             static_cast<int>(117 * test::noise(i, 3, 2)))] = i % 2 ? std::nanf("") : 1e30f;
  return image;
}

TEST(AcuityInvariance, tiles_and_windows_do_not_show_bit_for_bit) {
  const Image image = with_holes();
  for (const AcuityParameters& p : engines_and_widths()) {
    const AcuityFilter filter(p);
    const Image whole = test::filtered(p, image);
    for (const auto& [w, h, extra] : {Vec3<int>{151, 16, 0}, Vec3<int>{37, 29, 3}, Vec3<int>{64, 64, 0},
                                      Vec3<int>{151, 1, 0}, Vec3<int>{13, 117, 5}}) {
      if (h == 1 && p.sigma > 4.0) continue;  // slow, and says nothing new
      EXPECT_EQ(differing(whole, in_tiles(filter, image, w, h, extra)), 0)
          << "sigma " << p.sigma << " tiles " << w << "x" << h;
    }
  }
}

TEST(AcuityInvariance, threads_do_not_show_bit_for_bit) {
  const Image image = with_holes();
  const ParallelFor threads = [](int count, const std::function<void(int)>& task) {
    std::atomic<int> next{0};
    std::vector<std::jthread> pool;
    for (int t = 0; t < 4; ++t)
      pool.emplace_back([&] {
        for (int i; (i = next++) < count;) task(i);
      });
  };
  const ParallelFor backwards = [](int count, const std::function<void(int)>& task) {
    for (int i = count; i-- > 0;) task(i);
  };
  for (const AcuityParameters& p : engines_and_widths()) {
    const Image one = test::filtered(p, image);
    EXPECT_EQ(differing(one, test::filtered(p, image, threads)), 0) << "sigma " << p.sigma;
    EXPECT_EQ(differing(one, test::filtered(p, image, backwards)), 0) << "sigma " << p.sigma;
  }
}

TEST(AcuityInvariance, tall_images_do_not_show_their_strips) {
  const Image image = test::night(24, 700);
  for (const AcuityParameters& p : engines_and_widths()) {
    const Image whole = test::filtered(p, image);
    EXPECT_EQ(differing(whole, in_tiles(AcuityFilter(p), image, 24, 90, 0)), 0) << "sigma " << p.sigma;
  }
}

TEST(AcuityInvariance, every_instruction_set_agrees_within_rounding) {
  const Image image = test::night(101, 77);
  const auto chosen = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  };
  for (const AcuityParameters& p : engines_and_widths()) {
    chosen(0);
    const Image best = test::filtered(p, image);
    double worst = 0.0;
    std::size_t where = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
      chosen(left & -left);
      const Image out = test::filtered(p, image);
      for (std::size_t i = 0; i < out.planes[0].size(); ++i) {
        const int x = static_cast<int>(i) % image.width, y = static_cast<int>(i) / image.width;
        const Vec3<double> a = test::cielab(p, test::pixel(best, x, y)),
                           b = test::cielab(p, test::pixel(out, x, y));
        const double apart =
            std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) / (1.0 + std::abs(a[0]) / 100.0);
        if (!(apart <= worst)) {
          worst = apart;
          where = i;
        }
      }
    }
    chosen(0);
    std::printf("  sigma %.1f: instruction sets differ by %.1e CIELAB at pixel %zu\n", p.sigma, worst, where);
    EXPECT_LT(worst, 0.01) << "sigma " << p.sigma;
  }
}

}  // namespace
}  // namespace scotopic

// Glare once more, plainly: sums over all pairs of pixels in double, weights integrated over pixel squares.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <cstring>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "stages/glare/filter.h"
#include "stages/glare/pyramid/coarse_rows.h"
#include "stages/glare/pyramid/ladder.h"
#include "stages/glare/pyramid/pyramid.h"
#include "stages/glare/pyramid/rows.h"

namespace scotopic::test {

/// Weight of a pixel (dx, dy) away, not (0, 0): the function over its square, Gauss-Legendre on 4 x 4 parts
/// of 8 x 8.
inline double exact_weight(const GlareFunction& function, const GlareGrid& grid, int dx, int dy) {
  static constexpr double at[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                   0.9602898564975363};
  static constexpr double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                       0.1012285362903763};
  const int parts = std::max(std::abs(dx), std::abs(dy)) <= 2 ? 8 : 1;
  std::vector<std::pair<double, double>> nodes;
  for (int i = 0; i < parts; ++i)
    for (int k = 0; k < 8; ++k) {
      const double x = k < 4 ? -at[k] : at[k - 4];
      nodes.emplace_back((i + 0.5 + x / 2) / parts - 0.5, weight[k % 4] / (2 * parts));
    }
  double sum = 0;
  for (const auto& [y, wy] : nodes)
    for (const auto& [x, wx] : nodes)
      sum += wx * wy * function.psf(std::hypot((dx + x) / grid.ppd_x, (dy + y) / grid.ppd_y));
  const double radians = std::numbers::pi / 180;
  return grid.strength * sum * radians * radians / (grid.ppd_x * grid.ppd_y);
}

inline GlareGrid square_grid(int width, int height, double ppd) {
  return {width, height, ppd, ppd, GlareSides::end, 1};
}

inline GlareParameters parameters(int width, int height, double ppd = 20, GlareRule rule = GlareRule::above) {
  return {{}, square_grid(width, height, ppd), rule, 1};
}

inline ParallelFor threads(int n) {
  return [n](int count, const std::function<void(int)>& task) {
    std::atomic<int> next{0};
    std::vector<std::jthread> pool;
    for (int t = 0; t < n; ++t)
      pool.emplace_back([&] {
        for (int i; (i = next++) < count;) task(i);
      });
  };
}

/// A plane, row by row without gaps.
struct Plane {
  Plane(int w, int h, float value = 0)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}
  float& operator()(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  float operator()(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  int width, height;
  std::vector<float> values;
};

/// What the pyramid makes of a plane: K convolved with it.
inline Plane convolved(const GlareFunction& function, const GlareGrid& grid, const Plane& in) {
  const glare::Ladder ladder(function, grid);
  glare::Pyramid pyramid(ladder, 1);
  const glare::Level& level = ladder.levels.front();
  glare::Rows rows(grid.width, grid.height + 1);
  for (int y = 0; y < grid.height; ++y) {
    std::copy_n(&in.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(in.width)], in.width,
                rows.row(1 + y));
    glare::finish_row(rows.row(1 + y), grid.width, 0, grid.width, grid.sides);
  }
  pyramid.build(
      [&](int y, float* const* out) {
        std::copy_n(rows.row(1 + y) - glare::before, rows.stride(), out[0] - glare::before);
        return false;
      },
      serial_for);
  Plane out(grid.width, grid.height);
  glare::Scratch scratch(grid.width);
  glare::CoarseRows coarse(pyramid);
  glare::Rows sums(grid.width, 1);
  for (int y = 0; y < grid.height; ++y) {
    std::vector<const float*> around;
    for (int d = -level.reach(); d <= level.reach(); ++d)
      around.push_back(rows.row(y + d < 0 || y + d >= grid.height ? 0 : 1 + y + d));
    coarse.row(0, y, scratch, sums.row(0));
    glare::add_rungs(level, around.data(), 0, grid.width, scratch, sums.row(0));
    std::copy_n(sums.row(0), grid.width, &out(0, y));
  }
  return out;
}

/// Three planes and what a filter needs of them.
struct Picture {
  Picture(int w, int h, float value = 0) : planes(3, Plane(w, h, value)) {}
  GlarePicture view() {
    GlarePicture out;
    for (std::size_t k = 0; k < 3; ++k) out.rgb[k] = planes[k].values.data();
    for (Plane& plane : planes) out.light.push_back(plane.values.data());
    out.stride = planes[0].width;
    return out;
  }
  std::vector<Plane> planes;
};

/// Dark ground with noise, `lamps` coloured lamps of up to 10^decades.
inline Picture night(int width, int height, int lamps, double decades = 4, unsigned seed = 1) {
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

inline Picture filtered(const GlareParameters& p, Picture picture,
                        const ParallelFor& parallel_for = serial_for) {
  GlareFilter(p).apply(picture.view(), parallel_for);
  return picture;
}

inline bool same_bits(const Picture& a, const Picture& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::memcmp(a.planes[k].values.data(), b.planes[k].values.data(),
                    a.planes[k].values.size() * sizeof(float)) != 0)
      return false;
  return true;
}

/// The largest error, and how many pixels away from its source.
struct Worst {
  double error = 0;
  int dx = 0, dy = 0;
};

inline double sum(const Plane& plane) {
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0);
}

}  // namespace scotopic::test

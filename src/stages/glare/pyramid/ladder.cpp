#include "stages/glare/pyramid/ladder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "stages/glare/pyramid/taps.h"

namespace scotopic::glare {
namespace {

constexpr double radians = std::numbers::pi / 180;
// Rungs are sigma_j = 1.5 2^j pixels: the narrowest that samples carry (their sum is constant to 1e-10
// from 1.25 on).
constexpr double first_sigma = 1.5;
// Four in the picture itself: without the last, neighbours at 3 pixels per degree err by 3.8 % instead of 2.1
// %.
constexpr int finest_octave = -3;
constexpr int last_side = 24;
// Of a panorama, where the function's end at 90 degrees lies within the picture.
constexpr int last_side_of_panorama = 64;
// Octaves of the direct sum: the widest Gaussian is flat over any picture.
constexpr int octaves_above = 24;

struct Builder {
  const GlareFunction& function;
  const GlareGrid& grid;
  double coarse = std::min(grid.ppd_x, grid.ppd_y);

  double sigma(int j) const { return first_sigma * std::ldexp(1.0, j) / coarse; }
  double energy(int j) const {
    return grid.strength * 2 * std::numbers::pi * squared(sigma(j) * radians) * function.rung(sigma(j));
  }
  // In samples of a level.
  double across(int octave, const Level& at) const {
    return std::sqrt(squared(sigma(octave) * grid.ppd_x) - at.blur_x) / at.across;
  }
  double down(int octave, const Level& at) const {
    return std::sqrt(squared(sigma(octave) * grid.ppd_y) - at.blur_y) / at.down;
  }
  Rung box(int octave) const;
  Rung sampled(int octave, const Level& at) const;
  float direct(int octave, const Level& at, int dx, int dy) const;
};

std::vector<double> box_taps(double s) {
  std::vector<double> taps;
  const double scale = std::sqrt(0.5) / s;
  for (int i = 0; i <= reach_of(s); ++i)
    taps.push_back(0.5 * (std::erf((i + 0.5) * scale) - std::erf((i - 0.5) * scale)));
  return taps;
}

Rung Builder::box(int octave) const {
  return {scaled(box_taps(sigma(octave) * grid.ppd_x), energy(octave)),
          scaled(box_taps(sigma(octave) * grid.ppd_y), 1)};
}

Rung Builder::sampled(int octave, const Level& at) const {
  return {scaled(sampled_taps(across(octave, at)), energy(octave)),
          scaled(sampled_taps(down(octave, at)), 1)};
}

// All rungs from `octave` on.
float Builder::direct(int octave, const Level& at, int dx, int dy) const {
  const double theta = std::hypot(dx * at.across / grid.ppd_x, dy * at.down / grid.ppd_y);
  if (theta > 90) return 0;  // behind the eye
  const double pixels = at.across * at.down;
  double sum = function.wide(theta);
  for (int i = octave; i < octave + octaves_above; ++i) {
    const double sx = across(i, at), sy = down(i, at);
    const double narrowed = squared(sigma(i)) * grid.ppd_x * grid.ppd_y / (pixels * sx * sy);
    sum += function.rung(sigma(i)) * narrowed * std::exp(-squared(dx / sx) / 2 - squared(dy / sy) / 2);
  }
  const double solid_angle = squared(radians) * pixels / (grid.ppd_x * grid.ppd_y);
  return static_cast<float>(grid.strength * solid_angle * sum);
}

Level level_of(int width, int height, int beyond_x, int beyond_y) {
  return {width, height, -beyond_x, width + beyond_x, -beyond_y, height + beyond_y};
}

Level level_above(Level& below, GlareSides sides) {
  const bool meet = sides == GlareSides::meet, uneven = meet && below.width % 2 != 0;
  Level out = level_of((below.width + 1) / 2, (below.height + 1) / 2, meet ? 0 : margin, margin);
  if (uneven) below.wrapped = wrapped_of(below.width);
  out.across = below.across * (uneven ? static_cast<double>(below.width) / out.width : 2);
  out.down = 2 * below.down;
  // A squared sample up, and as much down.
  out.blur_x = below.blur_x + 2 * squared(below.across);
  out.blur_y = below.blur_y + 2 * squared(below.down);
  return out;
}

std::vector<Level> levels_of(const GlareGrid& grid) {
  const int most = grid.sides == GlareSides::meet ? last_side_of_panorama : last_side;
  std::vector<Level> out = {level_of(grid.width, grid.height, 0, 0)};
  do {
    Level above = level_above(out.back(), grid.sides);
    out.push_back(std::move(above));
  } while (std::max(out.back().width, out.back().height) > most);
  return out;
}

void check(const GlareGrid& g) {
  if (g.width < 1 || g.height < 1) throw std::invalid_argument("glare: a picture has at least one pixel");
  const double fine = std::max(g.ppd_x, g.ppd_y), coarse = std::min(g.ppd_x, g.ppd_y);
  if (!(coarse > 0 && std::isfinite(fine)))
    throw std::invalid_argument("glare: pixels per degree must be > 0");
  if (fine > 2 * coarse)
    throw std::invalid_argument("glare: pixels may be at most twice as wide as high, or high as wide");
  if (!(g.strength >= 0 && g.strength <= 1)) throw std::invalid_argument("glare: strength must be 0 to 1");
}

}  // namespace

Ladder::Ladder(const GlareFunction& function, const GlareGrid& grid) : sides(grid.sides) {
  check(grid);
  levels = levels_of(grid);
  const bool meet = sides == GlareSides::meet;

  const Builder build{function, grid};
  const int last = static_cast<int>(levels.size()) - 1;
  const int finest =
      finest_octave - static_cast<int>(std::ceil(std::log2(std::max(grid.ppd_x, grid.ppd_y) / build.coarse)));
  most = 0;
  for (int j = 0; j >= finest; --j) levels[0].rungs.push_back(build.box(j));
  for (int j = 1; j < last; ++j) {
    Level& at = levels[static_cast<std::size_t>(j)];
    at.rungs.push_back(build.sampled(j, at));
  }
  for (int j = finest; j < last; ++j) most += build.energy(j);

  halo = halo_of(function, grid, levels);
  most += grid.strength * function.halo();

  const Level& end = levels.back();
  top_width = end.x_end - end.x_begin;
  for (int dy = 0; dy < end.y_end - end.y_begin; ++dy)
    for (int dx = 0; dx < top_width; ++dx) {
      const int across = meet ? std::min(dx, top_width - dx) : dx;
      top.push_back(build.direct(last, end, across, dy));
      most += static_cast<double>(top.back()) * (dx == 0 || meet ? 1 : 2) * (dy == 0 ? 1 : 2);
    }
}

}  // namespace scotopic::glare

// Whether a scene calls for glare, from sums over blocks: no convolution.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "stages/glare/filter.h"
#include "stages/glare/plan.h"

namespace scotopic {
namespace glare {
namespace {

constexpr int side = 16;               // of a block, pixels
constexpr double unseen = 0.01;        // a relative change that nobody sees
constexpr double dark = 1e-3;          // of the threshold: what the display shows as black
constexpr double ladder_error = 1.03;  // the ladder's weights over those of the function, at most
constexpr std::size_t most_pairs = std::size_t{1} << 22;

/// Excess luminance of blocks, and the least luminance in each.
struct Blocks {
  Blocks(int width, int height)
      : columns((width + side - 1) / side),
        rows((height + side - 1) / side),
        excess(size()),
        least(size(), std::numeric_limits<double>::infinity()) {}
  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }
  int columns, rows;
  std::vector<double> excess, least;
};

bool operable(double x) { return std::abs(x) <= 0x1p120; }

void add_pixel(const Plan& plan, const std::array<double, 3>& weights, const std::array<double, 3>& rgb,
               Blocks& blocks, std::size_t at) {
  if (!(operable(rgb[0]) && operable(rgb[1]) && operable(rgb[2]))) return;
  const double luminance = std::max(0.0, weights[0] * rgb[0] + weights[1] * rgb[1] + weights[2] * rgb[2]);
  const double v = std::max({rgb[0], rgb[1], rgb[2]}), t = static_cast<double>(plan.threshold);
  blocks.least[at] = std::min(blocks.least[at], luminance);
  if (v > t) blocks.excess[at] += luminance * ((v - t) / v);
}

Blocks blocks_of(const Plan& plan, const GlarePicture& picture, const std::array<double, 3>& weights,
                 const ParallelFor& parallel_for) {
  Blocks blocks(plan.width(), plan.height());
  for_bands(plan.height(), side, parallel_for, [&](int band, int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const PictureRow row = row_of(picture, y);
      for (int x = 0; x < plan.width(); ++x)
        add_pixel(plan, weights, {double{row.rgb[0][x]}, double{row.rgb[1][x]}, double{row.rgb[2][x]}},
                  blocks, blocks.at(x / side, band));
    }
  });
  return blocks;
}

/// A square of `blocks` x `blocks` blocks with excess.
struct Source {
  int x, y;  ///< of its first block
  double excess;
};

std::vector<Source> sources_of(const Blocks& blocks, int group) {
  std::vector<Source> out;
  for (int y = 0; y < blocks.rows; y += group)
    for (int x = 0; x < blocks.columns; x += group) {
      double sum = 0;
      for (int j = y; j < std::min(y + group, blocks.rows); ++j)
        for (int i = x; i < std::min(x + group, blocks.columns); ++i) sum += blocks.excess[blocks.at(i, j)];
      if (sum > 0) out.push_back({x, y, sum});
    }
  return out;
}

/// Bounds on the weight between pixels of blocks, by how many blocks they are apart.
class Bound {
 public:
  Bound(const Plan& plan, const Blocks& blocks);
  /// From `source`, of `group` x `group` blocks, to block (x, y).
  double operator()(const Source& source, int group, int x, int y) const {
    const int across = apart(source.x, group, x), down = apart(source.y, group, y);
    return table_[static_cast<std::size_t>(down * columns_ +
                                           (meet_ ? around(source.x, group, x, across) : across))];
  }

 private:
  static int apart(int first, int group, int x) { return std::max({0, first - x, x - (first + group - 1)}); }
  // The last block of a row may be narrower: one block less is certain.
  int around(int first, int group, int x, int across) const {
    const int left = apart(first, group, x - columns_), right = apart(first, group, x + columns_);
    return std::min(across, std::max(0, std::min(left, right) - 1));
  }

  int columns_;
  bool meet_;
  std::vector<double> table_;
};

/// The function over the square of the pixel `dx`, `dy` pixels away, by the midpoint rule.
double pixel_weight(const Plan& plan, double dx, double dy) {
  constexpr int steps = 32;
  const GlareGrid& g = plan.parameters.grid;
  double sum = 0;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i)
      sum += plan.function.psf(
          std::hypot((dx - 0.5 + (i + 0.5) / steps) / g.ppd_x, (dy - 0.5 + (j + 0.5) / steps) / g.ppd_y));
  return sum / (steps * steps);
}

/// Distance of the nearest pixels' middles, of blocks so many apart.
double pixels_apart(int blocks) { return blocks == 0 ? 0 : side * (blocks - 1) + 1; }

Bound::Bound(const Plan& plan, const Blocks& blocks)
    : columns_(blocks.columns), meet_(plan.parameters.grid.sides == GlareSides::meet) {
  const GlareGrid& g = plan.parameters.grid;
  const double nearest = std::max(pixel_weight(plan, 1, 0), pixel_weight(plan, 0, 1));
  const double radians = std::acos(-1.0) / 180;
  const double scale = ladder_error * g.strength * radians * radians / (g.ppd_x * g.ppd_y);
  const double half_pixel = std::hypot(0.5 / g.ppd_x, 0.5 / g.ppd_y);
  for (int y = 0; y < blocks.rows; ++y)
    for (int x = 0; x < blocks.columns; ++x) {
      // Decreasing with the angle, so the nearest points bound the rest.
      const double theta = std::hypot(pixels_apart(x) / g.ppd_x, pixels_apart(y) / g.ppd_y) - half_pixel;
      table_.push_back(scale * (x < 2 && y < 2 ? nearest : plan.function.psf(std::min(theta, 90.0))));
    }
}

double relative(const Plan& plan, const Blocks& blocks, std::size_t at, double veil) {
  if (!(blocks.least[at] < std::numeric_limits<double>::infinity())) return 0;
  return veil / (blocks.least[at] + dark * static_cast<double>(plan.threshold));
}

/// What blocks with excess do to themselves and their neighbours: a lower limit of the bound, found at once.
double veil_nearby(const Plan& plan, const Blocks& blocks, const Bound& bound) {
  double greatest = 0;
  for (const Source& source : sources_of(blocks, 1))
    for (int y = std::max(0, source.y - 1); y <= std::min(source.y + 1, blocks.rows - 1); ++y)
      for (int x = std::max(0, source.x - 1); x <= std::min(source.x + 1, blocks.columns - 1); ++x)
        greatest = std::max(greatest,
                            relative(plan, blocks, blocks.at(x, y), source.excess * bound(source, 1, x, y)));
  return greatest;
}

/// The largest bound of all blocks. Sources are merged where pairs would be many: the bound stays one.
double veil_everywhere(const Plan& plan, const Blocks& blocks, const Bound& bound,
                       const ParallelFor& parallel_for) {
  int group = 1;
  std::vector<Source> sources = sources_of(blocks, group);
  while (sources.size() > 1 && sources.size() * blocks.size() > most_pairs)
    sources = sources_of(blocks, group *= 2);
  std::vector<double> greatest(static_cast<std::size_t>(blocks.rows));
  parallel_for(blocks.rows, [&](int y) {
    for (int x = 0; x < blocks.columns; ++x) {
      double veil = 0;
      for (const Source& source : sources) veil += source.excess * bound(source, group, x, y);
      double& most = greatest[static_cast<std::size_t>(y)];
      most = std::max(most, relative(plan, blocks, blocks.at(x, y), veil));
    }
  });
  return *std::max_element(greatest.begin(), greatest.end());
}

std::string worded(const char* format, double value) {
  char text[160];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

GlareNeed need_of_excess(const Plan& plan, const GlarePicture& picture,
                         const std::array<double, 3>& luminance, const ParallelFor& parallel_for) {
  GlareNeed need;
  need.above = count_above(plan, picture, parallel_for);
  if (need.above == 0) {
    need.reason = worded("no pixel is above %.4g", plan.parameters.threshold);
    return need;
  }
  const Blocks blocks = blocks_of(plan, picture, luminance, parallel_for);
  const Bound bound(plan, blocks);
  need.veil = veil_nearby(plan, blocks, bound);
  if (need.veil <= unseen) need.veil = veil_everywhere(plan, blocks, bound, parallel_for);
  need.called_for = need.veil > unseen;
  need.reason = worded(need.called_for ? "the veil may reach %.3g %% of what is under it"
                                       : "the veil is at most %.3g %% of what is under it",
                       100 * need.veil);
  return need;
}

GlareNeed need_of_all(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for) {
  GlareNeed need;
  need.above = count_above(plan, picture, parallel_for);
  const Extremes found = extremes(plan, picture, parallel_for);
  for (std::size_t k = 0; k < picture.light.size(); ++k) {
    const double least = double{found.least[k]}, greatest = double{found.greatest[k]};
    if (!(least < greatest)) continue;  // flat, or nothing finite
    const double ratio = least > 0 ? greatest / least - 1 : std::numeric_limits<double>::infinity();
    need.veil = std::max(need.veil, plan.ladder.most * ratio);
  }
  need.called_for = need.veil > unseen;
  need.reason = worded("components change by at most %.3g %%", 100 * need.veil);
  return need;
}

}  // namespace
}  // namespace glare

GlareNeed GlareFilter::need(const GlarePicture& picture, const std::array<double, 3>& luminance,
                            const ParallelFor& parallel_for) const {
  glare::check_picture(*plan_, picture);
  if (plan_->parameters.grid.strength == 0) return {false, 0, 0, "its strength is 0"};
  return plan_->parameters.rule == GlareRule::above
             ? glare::need_of_excess(*plan_, picture, luminance, parallel_for)
             : glare::need_of_all(*plan_, picture, parallel_for);
}

}  // namespace scotopic

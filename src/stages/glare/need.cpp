// Whether a scene calls for glare, from sums over blocks: no convolution.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "stages/glare/filter.h"
#include "stages/glare/halo.h"
#include "stages/glare/plan.h"

namespace scotopic {
namespace glare {
namespace {

constexpr int side = 16;               // of a block, pixels
constexpr double unseen = 0.01;        // a relative change that nobody sees
constexpr double dark = 1e-3;          // of the threshold: what the display shows as black
constexpr double ladder_error = 1.03;  // the ladder's weights over those of the function, at most
constexpr std::size_t most_pairs = std::size_t{1} << 22;

using Weights = std::array<double, 3>;

/// A picture in blocks: the excess luminance of each, and the least luminance in it.
class Blocks {
 public:
  Blocks(const Plan& plan, const GlarePicture& picture, const Weights& luminance,
         const ParallelFor& parallel_for);

  std::size_t size() const { return excess_.size(); }
  double excess(int x, int y) const { return excess_[at(x, y)]; }
  /// Infinity where nothing is finite. Found when first asked for: one thread for each row of blocks.
  double least(int x, int y);

  const int columns, rows;

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }
  template <typename Visit>
  void visit(int x, int y, Visit visit) const;
  bool lit(int x, int y) const;
  double excess_of(int x, int y) const;

  const Plan& plan_;
  const GlarePicture& picture_;
  const Weights weights_;
  std::vector<double> excess_, least_;
};

bool operable(double x) { return std::abs(x) <= 0x1p120; }

int blocks_along(int pixels) { return (pixels + side - 1) / side; }

Blocks::Blocks(const Plan& plan, const GlarePicture& picture, const Weights& luminance,
               const ParallelFor& parallel_for)
    : columns(blocks_along(plan.width())),
      rows(blocks_along(plan.height())),
      plan_(plan),
      picture_(picture),
      weights_(luminance) {
  excess_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  least_.resize(excess_.size(), -1);
  parallel_for(rows, [&](int y) {
    for (int x = 0; x < columns; ++x) excess_[at(x, y)] = lit(x, y) ? excess_of(x, y) : 0;
  });
}

/// visit(luminance, greatest component) of each finite pixel of a block.
template <typename Visit>
void Blocks::visit(int x, int y, Visit visit) const {
  for (int j = y * side; j < std::min((y + 1) * side, plan_.height()); ++j) {
    const PictureRow row = row_of(picture_, j);
    for (int i = x * side; i < std::min((x + 1) * side, plan_.width()); ++i) {
      const double r = double{row.rgb[0][i]}, g = double{row.rgb[1][i]}, b = double{row.rgb[2][i]};
      if (!(operable(r) && operable(g) && operable(b))) continue;
      visit(std::max(0.0, weights_[0] * r + weights_[1] * g + weights_[2] * b), std::max({r, g, b}));
    }
  }
}

bool Blocks::lit(int x, int y) const {
  for (int j = y * side; j < std::min((y + 1) * side, plan_.height()); ++j) {
    if (known_below(plan_, picture_, j)) continue;
    PictureRow row = row_of(picture_, j);
    for (const float*& plane : row.rgb) plane += x * side;
    if (count_above(row, plan_.threshold, std::min(side, plan_.width() - x * side)) > 0) return true;
  }
  return false;
}

double Blocks::excess_of(int x, int y) const {
  double sum = 0;
  const double t = double{plan_.threshold};
  visit(x, y, [&](double luminance, double v) { sum += v > t ? luminance * ((v - t) / v) : 0; });
  return sum;
}

double Blocks::least(int x, int y) {
  double& least = least_[at(x, y)];
  if (least >= 0) return least;
  least = std::numeric_limits<double>::infinity();
  visit(x, y, [&](double luminance, double) { least = std::min(least, luminance); });
  return least;
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
        for (int i = x; i < std::min(x + group, blocks.columns); ++i) sum += blocks.excess(i, j);
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

/// At most what the halo sends `theta` degrees or farther.
double halo_bound(const GlareFunction& function, const GlareGrid& grid, double theta) {
  const auto [low, high] = std::minmax_element(halo_wavelengths.begin(), halo_wavelengths.end());
  // Drawn wider where pixels are few, and never higher.
  const double across = 6 * std::hypot(halo_sigma, 2 / std::min(grid.ppd_x, grid.ppd_y));
  return theta > halo_radius(*high) + across ? 0 : function.halo() * halo_psf(halo_radius(*low), *low);
}

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
      const double near = x < 2 && y < 2 ? nearest : plan.function.psf(std::min(theta, 90.0));
      table_.push_back(scale * (near + halo_bound(plan.function, g, theta)));
    }
}

/// The veil in block (x, y) over what is under it.
double relative(const Plan& plan, Blocks& blocks, int x, int y, double veil) {
  const double least = blocks.least(x, y);
  return std::isinf(least) ? 0 : veil / (least + dark * double{plan.threshold});
}

/// What blocks with excess do to themselves and their neighbours, up to the first that is enough: a lower
/// limit of the bound, found at once.
double veil_nearby(const Plan& plan, Blocks& blocks, const Bound& bound) {
  double greatest = 0;
  for (const Source& source : sources_of(blocks, 1))
    for (int y = std::max(0, source.y - 1); y <= std::min(source.y + 1, blocks.rows - 1); ++y)
      for (int x = std::max(0, source.x - 1); x <= std::min(source.x + 1, blocks.columns - 1); ++x) {
        const double veil = source.excess * bound(source, 1, x, y);
        greatest = std::max(greatest, relative(plan, blocks, x, y, veil));
        if (greatest > unseen) return greatest;
      }
  return greatest;
}

/// The largest bound of all blocks. Sources are merged where pairs would be many: the bound stays one.
double veil_everywhere(const Plan& plan, Blocks& blocks, const Bound& bound,
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
      most = std::max(most, relative(plan, blocks, x, y, veil));
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
  Blocks blocks(plan, picture, luminance, parallel_for);
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
  glare::check_subimage(*plan_, picture);
  if (plan_->parameters.grid.strength == 0) return {false, 0, 0, "its strength is 0"};
  return plan_->parameters.rule == GlareRule::above
             ? glare::need_of_excess(*plan_, picture, luminance, parallel_for)
             : glare::need_of_all(*plan_, picture, parallel_for);
}

}  // namespace scotopic

#include "stages/acuity/local.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>

#include "stages/acuity/cutoff.h"
#include "stages/acuity/engines.h"
#include "stages/require.h"

namespace scotopic {
namespace {

constexpr int block = 128;           // pixels; results do not depend on it
constexpr double reach = 3.0;        // of the surround, in its sigmas
constexpr double brightest = 1e4;    // times the scene's white
constexpr double least_sigma = 0.3;  // pixels: below, no neighbour weighs 1 %

}  // namespace

struct LocalAcuityFilter::Plan {
  LocalAcuityParameters parameters;
  double surround_sigma = 0;  // pixels
  int cell = 1;               // pixels of the surround's grid
  int halo = 0;
  double luminance[3] = {};  // of R, G, B, cd/m2
  double most = 0;           // cd/m2
  double sigma = 0;          // of level 0, pixels
  std::vector<AcuityFilter> levels;

  double level(double surround) const;
  void filter_block(const AcuityWindow& window, const AcuityTile& tile, const Surround& surround) const;
  void filter_level(std::size_t level, const AcuityWindow& window, const AcuityTile& tile) const;
};

/// Mean luminance around each place, on a grid of cells that belongs to the image, not to the window.
class LocalAcuityFilter::Surround {
 public:
  Surround(const Plan& plan, const AcuityWindow& window, const AcuityTile& tile);
  /// At a pixel of the tile, cd/m2.
  double at(int x, int y) const;

 private:
  struct Sum {
    double luminance = 0, pixels = 0;
  };
  Sum& sum(int column, int row) {
    return sums_[static_cast<std::size_t>((row - row_) * columns_ + column - column_)];
  }
  void add_pixels(const Plan& plan, const AcuityWindow& window);
  void blur(const Plan& plan, bool across);

  int cell_;
  int column_, row_, columns_, rows_;  // of the cells held
  std::vector<Sum> sums_;
};

LocalAcuityFilter::Surround::Surround(const Plan& plan, const AcuityWindow& window, const AcuityTile& tile)
    : cell_(plan.cell) {
  // Cells whose neighbours are all known reach one beyond the tile, for the interpolation.
  const int more = 1 + static_cast<int>(std::ceil(reach * plan.surround_sigma / cell_));
  column_ = tile.x / cell_ - more - 1;
  row_ = tile.y / cell_ - more - 1;
  columns_ = (tile.x + tile.width - 1) / cell_ + more + 2 - column_;
  rows_ = (tile.y + tile.height - 1) / cell_ + more + 2 - row_;
  sums_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  add_pixels(plan, window);
  blur(plan, true);
  blur(plan, false);
}

void LocalAcuityFilter::Surround::add_pixels(const Plan& plan, const AcuityWindow& window) {
  const int y0 = std::max(window.y, row_ * cell_),
            y1 = std::min(window.y + window.height, (row_ + rows_) * cell_);
  const int x0 = std::max(window.x, column_ * cell_),
            x1 = std::min(window.x + window.width, (column_ + columns_) * cell_);
  for (int y = y0; y < y1; ++y) {
    const std::ptrdiff_t offset = (y - window.y) * window.stride - window.x;
    for (int x = x0; x < x1; ++x) {
      const double luminance = plan.luminance[0] * window.r[offset + x] +
                               plan.luminance[1] * window.g[offset + x] +
                               plan.luminance[2] * window.b[offset + x];
      if (!std::isfinite(luminance)) continue;
      Sum& to = sum(x / cell_, y / cell_);
      to.luminance += std::clamp(luminance, 0.0, plan.most);
      to.pixels += 1.0;
    }
  }
}

void LocalAcuityFilter::Surround::blur(const Plan& plan, bool across) {
  const int half = static_cast<int>(std::ceil(reach * plan.surround_sigma / cell_));
  std::vector<double> taps(static_cast<std::size_t>(half) + 1);
  for (int i = 0; i <= half; ++i) {
    const double d = i * cell_ / plan.surround_sigma;
    taps[static_cast<std::size_t>(i)] = std::exp(-0.5 * d * d);
  }
  std::vector<Sum> out(sums_.size());
  const int step = across ? 1 : columns_, length = across ? columns_ : rows_;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const int at = row * columns_ + column, place = across ? column : row;
      Sum total;
      for (int i = -half; i <= half; ++i) {
        if (place + i < 0 || place + i >= length) continue;
        const Sum& from = sums_[static_cast<std::size_t>(at + i * step)];
        const double tap = taps[static_cast<std::size_t>(std::abs(i))];
        total.luminance += tap * from.luminance;
        total.pixels += tap * from.pixels;
      }
      out[static_cast<std::size_t>(at)] = total;
    }
  sums_ = std::move(out);
}

double LocalAcuityFilter::Surround::at(int x, int y) const {
  const double fx = (x + 0.5) / cell_ - 0.5, fy = (y + 0.5) / cell_ - 0.5;
  const int column = static_cast<int>(std::floor(fx)), row = static_cast<int>(std::floor(fy));
  Sum total;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double share = (i ? fx - column : 1.0 - (fx - column)) * (j ? fy - row : 1.0 - (fy - row));
      const Sum& from = sums_[static_cast<std::size_t>((row + j - row_) * columns_ + column + i - column_)];
      total.luminance += share * from.luminance;
      total.pixels += share * from.pixels;
    }
  return total.pixels > 0.0 ? total.luminance / total.pixels : 0.0;
}

LocalAcuityFilter::LocalAcuityFilter(const LocalAcuityParameters& p) {
  require(positive(p.adaptation), "LocalAcuityFilter: adaptation must be > 0");
  require(positive(p.white_luminance), "LocalAcuityFilter: white_luminance must be > 0");
  require(positive(p.pixels_per_degree), "LocalAcuityFilter: pixels_per_degree must be > 0");
  auto plan = std::make_unique<Plan>();
  plan->parameters = p;
  // Width at half height, of a Gaussian: 2 sqrt(2 ln 2) sigma.
  plan->surround_sigma = p.pixels_per_degree / (2.0 * std::sqrt(2.0 * std::numbers::ln2));
  plan->cell = std::max(1, static_cast<int>(plan->surround_sigma / 4.0));
  for (std::size_t k = 0; k < 3; ++k) plan->luminance[k] = p.filter.xyz_from_rgb[1][k] * p.white_luminance;
  plan->most = brightest * p.adaptation / 0.18;
  plan->sigma = acuity_sigma_pixels(p.adaptation, p.pixels_per_degree);
  AcuityParameters level = p.filter;
  level.white = p.adaptation / 0.18 / p.white_luminance;
  for (level.sigma = plan->sigma; level.sigma >= least_sigma; level.sigma /= std::numbers::sqrt2)
    plan->levels.emplace_back(level);
  const int surround = static_cast<int>(std::ceil(reach * plan->surround_sigma)) + 4 * plan->cell;
  if (!plan->levels.empty() && p.filter.strength > 0.0)
    plan->halo = std::max(plan->levels.front().halo(), surround);
  plan_ = std::move(plan);
}

LocalAcuityFilter::~LocalAcuityFilter() = default;
LocalAcuityFilter::LocalAcuityFilter(LocalAcuityFilter&&) noexcept = default;
LocalAcuityFilter& LocalAcuityFilter::operator=(LocalAcuityFilter&&) noexcept = default;

int LocalAcuityFilter::halo() const noexcept { return plan_->halo; }

/// 0: sigma of La; each 1 more: smaller by sqrt(2). From levels.size() on: the identity.
double LocalAcuityFilter::Plan::level(double surround) const {
  const double own = acuity_sigma_pixels(parameters.adaptation + surround, parameters.pixels_per_degree);
  return std::clamp(2.0 * std::log2(sigma / own), 0.0, static_cast<double>(levels.size()));
}

void LocalAcuityFilter::Plan::filter_level(std::size_t level, const AcuityWindow& window,
                                           const AcuityTile& tile) const {
  if (level < levels.size()) return levels[level].filter(window, tile);
  AcuityParameters none = parameters.filter;
  none.sigma = 0.0;
  AcuityFilter(none).filter(window, tile);
}

void LocalAcuityFilter::Plan::filter_block(const AcuityWindow& window, const AcuityTile& tile,
                                           const Surround& surround) const {
  const auto pixels = static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
  std::vector<double> at_level(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    at_level[i] = level(
        surround.at(tile.x + static_cast<int>(i) % tile.width, tile.y + static_cast<int>(i) / tile.width));
  const auto [low, high] = std::minmax_element(at_level.begin(), at_level.end());
  std::vector<float> result(3 * pixels);
  AcuityTile one = tile;
  one.r = result.data();
  one.g = one.r + pixels;
  one.b = one.g + pixels;
  one.stride = tile.width;
  float* const planes[3] = {tile.r, tile.g, tile.b};
  for (auto l = static_cast<std::size_t>(*low); static_cast<double>(l) < *high + 1.0; ++l) {
    filter_level(l, window, one);
    for (std::size_t i = 0; i < pixels; ++i) {
      const double above = at_level[i] - static_cast<double>(l);
      if (above <= -1.0 || above >= 1.0) continue;
      const auto x = static_cast<std::ptrdiff_t>(i) % tile.width,
                 y = static_cast<std::ptrdiff_t>(i) / tile.width;
      for (std::size_t k = 0; k < 3; ++k) {
        float& out = planes[k][y * tile.stride + x];
        const float here = result[k * pixels + i];
        // The lower level comes first and sets the pixel; the upper one, if it has a share, is mixed in.
        if (above >= 0.0)
          out = here;
        else if (std::bit_cast<std::uint32_t>(here) != std::bit_cast<std::uint32_t>(out))
          out += static_cast<float>(1.0 + above) * (here - out);
      }
    }
  }
}

void LocalAcuityFilter::filter(const AcuityWindow& window, const AcuityTile& tile,
                               const ParallelFor& parallel_for) const {
  if (tile.width <= 0 || tile.height <= 0) return;
  acuity::require_window(window, tile, plan_->halo);
  if (plan_->halo == 0) return plan_->filter_level(plan_->levels.size(), window, tile);
  const int across = (tile.width + block - 1) / block, down = (tile.height + block - 1) / block;
  parallel_for(across * down, [&](int i) {
    AcuityTile part = tile;
    part.x += i % across * block;
    part.y += i / across * block;
    part.width = std::min(block, tile.x + tile.width - part.x);
    part.height = std::min(block, tile.y + tile.height - part.y);
    const std::ptrdiff_t offset = (part.y - tile.y) * tile.stride + part.x - tile.x;
    part.r += offset;
    part.g += offset;
    part.b += offset;
    plan_->filter_block(window, part, Surround(*plan_, window, part));
  });
}

}  // namespace scotopic

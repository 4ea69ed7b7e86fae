#include "stages/acuity/filter.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <string>

#include "stages/acuity/engines.h"
#include "stages/require.h"

namespace scotopic {
namespace {

using acuity::CellRow;
using acuity::Constants;
using acuity::LabRows;

/// Reach of either engine in sigmas; side of a cell in sigmas, largest variance in a cell in range sigmas
/// squared, clusters of a cell at most, step of the lattice of colours in range sigmas, and how rare colours
/// must be to be dropped.
struct Tuning {
  double window_reach, cells_reach, cell, variance;
  int most_clusters;
  double pitch, rarity;
};

/// Measured against double brute force of reach 3.5 on night and daylight HDR images: docs/acuity.md.
Tuning tuning_of(AcuityQuality quality) {
  switch (quality) {
    case AcuityQuality::draft:
      return {2.5, 2.5, 0.6, 0.1, 16, 1.5, 3.0};
    case AcuityQuality::normal:
      return {2.75, 3.0, 0.5, 0.03, 64, 1.0, 1.0};
    case AcuityQuality::fine:
      break;
  }
  return {3.5, 3.5, 0.34, 0.01, 128, 0.5, 0.1};
}

/// Variance along one axis of a Gaussian of standard deviation 1 cut off at radius `reach`.
double cut_variance(double reach) {
  const double u = 0.5 * reach * reach;
  return 1.0 - u * std::exp(-u) / -std::expm1(-u);
}

/// Standard deviation of the Gaussian that, cut off at `reach`, has the variance of the unit Gaussian cut off
/// at 3.5: cutting the tails short must not sharpen the picture.
double widened_sigma(double reach) {
  const double wanted = cut_variance(3.5);
  double low = 0.5, high = 2.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * middle * cut_variance(reach / middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <typename T>
void copy_matrix(const Matrix3<double>& from, T (&to)[3][3]) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) to[i][j] = static_cast<T>(from[i][j]);
}

}  // namespace

struct AcuityFilter::Plan {
  Constants constants;
  AcuityEngine engine = AcuityEngine::window;
  bool identity = true;
  int halo = 0;
  int reach = 0;

  void filter_window(const AcuityWindow&, const AcuityTile&, const ParallelFor&) const;
  void filter_cells(const AcuityWindow&, const AcuityTile&, const ParallelFor&) const;
};

namespace {

void check(const AcuityParameters& p) {
  require(std::isfinite(p.sigma) && p.sigma >= 0.0 && p.sigma <= 1e4,
          "AcuityFilter: sigma must be 0 ... 1e4 pixels");
  require(p.pixel_aspect >= 0.1 && p.pixel_aspect <= 10.0, "AcuityFilter: pixel_aspect must be 0.1 ... 10");
  require(p.pixel_aspect == 1.0 || p.engine != AcuityEngine::cells,
          "AcuityFilter: cells takes pixels for square");
  require(std::isfinite(p.range_sigma) && p.range_sigma > 0.0, "AcuityFilter: range_sigma must be > 0");
  require(std::isfinite(p.white) && p.white > 0.0, "AcuityFilter: white must be > 0");
  require(p.strength >= 0.0 && p.strength <= 1.0, "AcuityFilter: strength must be 0 ... 1");
  const double det = determinant(p.xyz_from_rgb);
  require(std::isfinite(det) && det != 0.0, "AcuityFilter: xyz_from_rgb has no inverse");
}

int cell_of(double sigma, const Tuning& tuning) {
  return std::max(1, static_cast<int>(std::lround(tuning.cell * sigma)));
}

/// Cells are no gain where they hold a pixel or two, nor where a block is large against sigma.
AcuityEngine engine_of(const AcuityParameters& p, const Tuning& tuning) {
  if (p.engine != AcuityEngine::automatic) return p.engine;
  return p.pixel_aspect != 1.0 || p.sigma < 3.5 || cell_of(p.sigma, tuning) < 2 ? AcuityEngine::window
                                                                                : AcuityEngine::cells;
}

Constants constants_of(const AcuityParameters& p, const Tuning& tuning, AcuityEngine engine) {
  const double reach = engine == AcuityEngine::window ? tuning.window_reach : tuning.cells_reach;
  Constants c;
  const Vec3<double> white = p.white * p.xyz_from_rgb * Vec3<double>{1.0, 1.0, 1.0};
  const Matrix3<double> relative =
      diagonal<double>({1.0 / white[0], 1.0 / white[1], 1.0 / white[2]}) * p.xyz_from_rgb;
  copy_matrix(relative, c.f_from_rgb);
  copy_matrix(inverse(relative), c.rgb_from_f3);
  c.lab_scale = static_cast<float>(1.0 / (std::sqrt(2.0 * acuity::weight_end) * p.range_sigma));
  c.strength = static_cast<float>(p.strength);
  c.pixel_aspect = static_cast<float>(p.pixel_aspect);
  c.space = p.space;
  c.radius = reach * p.sigma;
  const double sigma = p.sigma * widened_sigma(reach);
  c.space_scale = static_cast<float>(1.0 / (2.0 * sigma * sigma * acuity::weight_end));
  c.split_variance = static_cast<float>(tuning.variance / (2.0 * acuity::weight_end));
  // Under 0.1 CIELAB units nothing is gained, and the lattice would not reach lab_limit.
  const double pitch = std::max(tuning.pitch * p.range_sigma, 0.1);
  c.per_pitch = static_cast<float>(1.0 / (pitch * static_cast<double>(c.lab_scale)));
  c.cell = cell_of(p.sigma, tuning);
  c.most_clusters = tuning.most_clusters;
  c.block_width = 8 * std::max(1, static_cast<int>(std::lround(p.sigma / 8.0)));
  c.block_height = p.sigma < 4.5 ? 4 : c.block_width;
  c.rarity = static_cast<float>(tuning.rarity);
  // Reach is from a block's middle; its corners should still see most of their Gaussian.
  if (engine == AcuityEngine::cells) c.radius += 0.14 * std::hypot(c.block_width, c.block_height);
  return c;
}

}  // namespace

AcuityFilter::AcuityFilter(const AcuityParameters& p) {
  check(p);
  auto plan = std::make_unique<Plan>();
  const Tuning tuning = tuning_of(p.quality);
  plan->engine = engine_of(p, tuning);
  plan->identity = p.strength == 0.0 || p.sigma * std::max(1.0, p.pixel_aspect) * tuning.window_reach < 1.0;
  if (!plan->identity) {
    const Constants& c = plan->constants = constants_of(p, tuning, plan->engine);
    plan->reach = static_cast<int>(std::ceil(c.radius * std::max(1.0, p.pixel_aspect)));
    plan->halo = plan->reach;
    // A cell within reach must lie in the window whole.
    if (plan->engine == AcuityEngine::cells) plan->halo += c.cell + std::max(c.block_width, c.block_height);
  }
  plan_ = std::move(plan);
}

AcuityFilter::~AcuityFilter() = default;
AcuityFilter::AcuityFilter(AcuityFilter&&) noexcept = default;
AcuityFilter& AcuityFilter::operator=(AcuityFilter&&) noexcept = default;

int AcuityFilter::halo() const noexcept { return plan_->halo; }
AcuityEngine AcuityFilter::engine() const noexcept { return plan_->engine; }

namespace {

/// The part of the window that the tile needs.
AcuityWindow cropped(const AcuityWindow& window, const AcuityTile& tile, int halo) {
  AcuityWindow part = window;
  part.x = std::max(window.x, tile.x - halo);
  part.y = std::max(window.y, tile.y - halo);
  part.width = std::min(window.x + window.width, tile.x + tile.width + halo) - part.x;
  part.height = std::min(window.y + window.height, tile.y + tile.height + halo) - part.y;
  const std::ptrdiff_t offset = (part.y - window.y) * window.stride + part.x - window.x;
  part.r += offset;
  part.g += offset;
  part.b += offset;
  return part;
}

}  // namespace

void AcuityFilter::filter(const AcuityWindow& window, const AcuityTile& tile,
                          const ParallelFor& parallel_for) const {
  if (tile.width <= 0 || tile.height <= 0) return;
  acuity::require_window(window, tile, plan_->halo);
  if (plan_->identity) return copy_tile(window, tile);
  const AcuityWindow needed = cropped(window, tile, plan_->halo);
  if (plan_->engine == AcuityEngine::window) return plan_->filter_window(needed, tile, parallel_for);
  plan_->filter_cells(needed, tile, parallel_for);
}

void copy_tile(const AcuityWindow& window, const AcuityTile& tile) noexcept {
  const std::ptrdiff_t from = (tile.y - window.y) * window.stride + tile.x - window.x;
  for (int y = 0; y < tile.height; ++y) {
    std::copy_n(window.r + from + y * window.stride, tile.width, tile.r + y * tile.stride);
    std::copy_n(window.g + from + y * window.stride, tile.width, tile.g + y * tile.stride);
    std::copy_n(window.b + from + y * window.stride, tile.width, tile.b + y * tile.stride);
  }
}

namespace {
constexpr int strip_height = 256;   // output rows between which scratch rows are given back
constexpr int task_pixels = 16384;  // of one task of the cells engine, about
constexpr int task_height = 16;     // output rows of one task of the window engine
constexpr int lane_margin = 32;     // pixels that one step of the window engine may read beyond a row
}  // namespace

void AcuityFilter::Plan::filter_window(const AcuityWindow& window, const AcuityTile& tile,
                                       const ParallelFor& parallel_for) const {
  const int height = std::min(strip_height, tile.height);
  LabRows rows(window.width, reach + lane_margin, height + 2 * reach);
  for (int y = tile.y; y < tile.y + tile.height; y += height) {
    const int end = std::min(y + height, tile.y + tile.height);
    parallel_for(end - y + 2 * reach,
                 [&](int i) { acuity::build_lab_row(constants, window, y - reach + i, rows, i); });
    parallel_for((end - y + task_height - 1) / task_height, [&](int i) {
      const int at = y + i * task_height;
      acuity::filter_from_window(constants, window, tile, at, std::min(task_height, end - at), rows,
                                 at - y + reach);
    });
  }
}

void AcuityFilter::Plan::filter_cells(const AcuityWindow& window, const AcuityTile& tile,
                                      const ParallelFor& parallel_for) const {
  const int cell = constants.cell, width = constants.block_width, height = constants.block_height;
  const auto row_of = [&](int y) { return std::clamp(y, window.y, window.y + window.height - 1) / cell; };
  const int first_block = tile.x / width, end_block = (tile.x + tile.width - 1) / width + 1;
  const int task_blocks = std::max(1, task_pixels / (width * height));
  const int tasks_across = (end_block - first_block + task_blocks - 1) / task_blocks;
  const int strip = std::max(1, strip_height / height) * height;
  std::deque<CellRow> rows;  // grid rows first ... first + size - 1
  int first = row_of(tile.y - halo);
  for (int y = tile.y / height * height; y < tile.y + tile.height; y += strip) {
    const int end = std::min(y + strip, tile.y + tile.height);
    for (; first < row_of(y - halo) && !rows.empty(); ++first) rows.pop_front();
    const int built = static_cast<int>(rows.size());
    rows.resize(static_cast<std::size_t>(row_of(end + halo) - first + 1));
    parallel_for(static_cast<int>(rows.size()) - built, [&](int i) {
      acuity::build_cell_row(constants, window, first + built + i, rows[static_cast<std::size_t>(built + i)]);
    });
    std::vector<const CellRow*> pointers;
    for (const CellRow& row : rows) pointers.push_back(&row);
    parallel_for((end - y + height - 1) / height * tasks_across, [&](int i) {
      const int block_y = y + height * (i / tasks_across);
      const int block = first_block + task_blocks * (i % tasks_across);
      const int low = std::max(row_of(block_y - reach), first), high = row_of(block_y + height + reach);
      acuity::filter_from_cells(constants, window, tile, block_y, block,
                                std::min(block + task_blocks, end_block), pointers.data() + (low - first),
                                low, high - low + 1);
    });
  }
}

void acuity::require_window(const AcuityWindow& window, const AcuityTile& tile, int halo) {
  const auto holds = [halo](int low, int size, int tile_low, int tile_size, int image) {
    return low >= 0 && low <= std::max(0, tile_low - halo) && low + size <= image && tile_low >= low &&
           tile_low + tile_size <= low + size && low + size >= std::min(image, tile_low + tile_size + halo);
  };
  require(holds(window.x, window.width, tile.x, tile.width, window.image_width) &&
              holds(window.y, window.height, tile.y, tile.height, window.image_height),
          "AcuityFilter: the window must hold the tile and its halo");
}

acuity::LabRows::LabRows(int width, int margin_pixels, int row_count) : margin(margin_pixels) {
  // An odd number of cache lines: rows and planes then fall into different sets of the first cache.
  const std::ptrdiff_t lines = (width + 2 * margin_pixels + 15) / 16;
  stride = 16 * (lines | 1);
  values = std::make_unique_for_overwrite<float[]>(static_cast<std::size_t>(6 * stride * row_count));
}

}  // namespace scotopic

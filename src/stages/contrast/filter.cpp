#include "stages/contrast/filter.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "stages/acuity/engines.h"
#include "stages/contrast/block.h"
#include "stages/require.h"
#include "stages/spares.h"

namespace scotopic {
namespace {

using contrast::Block;
using contrast::Constants;
using contrast::ExcessTable;

constexpr int block_rows = 128;

void check(const ContrastParameters& p) {
  const double white = p.luminance[0] + p.luminance[1] + p.luminance[2];
  require(positive(white), "ContrastFilter: luminance must be finite, and > 0 for R = G = B = 1");
  require(positive(p.unit), "ContrastFilter: unit must be > 0");
  require(p.adaptation >= 1e-6 && p.adaptation <= 1e6,
          "ContrastFilter: adaptation must be 1e-6 ... 1e6 cd/m2");
  require(positive(p.pixels_per_degree) && p.pixels_per_degree <= 1000.0,
          "ContrastFilter: pixels_per_degree must be > 0 and at most 1000");
  require(positive(p.display.scale) && positive(p.display.peak),
          "ContrastFilter: display must have scale and peak > 0");
  require(p.strength >= 0.0 && p.strength <= 1.0, "ContrastFilter: strength must be 0 ... 1");
}

/// From the floor of luminance to 1e6 cd/m2. A 256th of an octave is within 4e-4 decades of the function;
/// within 4e-3 of it where it bends at its limit of 1.
ExcessTable excess_table(const ContrastParameters& p, double frequency) {
  constexpr double per_octave = 256.0;
  ExcessTable table;
  table.per_octave = static_cast<float>(per_octave);
  table.first = std::floor(std::log2(contrast::darkest));
  const double last = std::max(4.0, std::log2(1e6 / p.adaptation));
  for (double x = table.first; x <= last; x += 1.0 / per_octave) {
    const double light = p.adaptation * std::exp2(x);
    const double excess = contrast::threshold_excess(frequency, p.adaptation, light, p.display);
    table.values.push_back(static_cast<float>(contrast::log2_of_10 * excess));
  }
  return table;
}

Constants constants_of(const ContrastParameters& p) {
  const double relative = p.unit / p.adaptation;
  const auto weight = [&](std::size_t i) { return static_cast<float>(relative * p.luminance[i]); };
  const double white = p.luminance[0] + p.luminance[1] + p.luminance[2];
  const double black = static_cast<double>(contrast::darkest) / (relative * white);
  Constants c{
      {weight(0), weight(1), weight(2)}, {}, {static_cast<float>(p.strength), static_cast<float>(black)}};
  for (double rho : contrast::band_frequencies(p.pixels_per_degree)) c.bands.push_back(excess_table(p, rho));
  const auto fades = [](const ExcessTable& t) {
    return std::any_of(t.values.begin(), t.values.end(), [](float x) { return x > 0.0f; });
  };
  // Coarse bands that nothing is taken from would only cost; finer ones are there for the coarser.
  while (!c.bands.empty() && !fades(c.bands.back())) c.bands.pop_back();
  if (p.strength == 0.0) c.bands.clear();
  return c;
}

/// Rows begin ... of a tile.
AcuityTile rows_of(const AcuityTile& tile, int begin, int height) {
  AcuityTile rows = tile;
  for (float** plane : {&rows.r, &rows.g, &rows.b}) *plane += begin * tile.stride;
  rows.y += begin;
  rows.height = height;
  return rows;
}

}  // namespace

struct ContrastFilter::Plan {
  Constants constants;
  int halo = 0;
};

ContrastFilter::ContrastFilter(const ContrastParameters& parameters) {
  check(parameters);
  auto plan = std::make_unique<Plan>();
  plan->constants = constants_of(parameters);
  const int bands = static_cast<int>(plan->constants.bands.size());
  plan->halo = bands == 0 ? 0 : contrast::pyramid_halo(bands);
  plan_ = std::move(plan);
}

ContrastFilter::~ContrastFilter() = default;
ContrastFilter::ContrastFilter(ContrastFilter&&) noexcept = default;
ContrastFilter& ContrastFilter::operator=(ContrastFilter&&) noexcept = default;

int ContrastFilter::halo() const noexcept { return plan_->halo; }
int ContrastFilter::bands() const noexcept { return static_cast<int>(plan_->constants.bands.size()); }

void ContrastFilter::filter(const AcuityWindow& window, const AcuityTile& tile,
                            const ParallelFor& parallel_for) const {
  acuity::require_window(window, tile, plan_->halo);
  if (tile.width <= 0 || tile.height <= 0) return;
  if (bands() == 0) return copy_tile(window, tile);
  const int blocks = (tile.height + block_rows - 1) / block_rows;
  Spares<Block> idle;
  parallel_for(blocks, [&](int i) {
    const int begin = i * block_rows;
    idle.with([&] { return std::make_unique<Block>(plan_->constants); },
              [&](Block& block) {
                block.filter(window, rows_of(tile, begin, std::min(block_rows, tile.height - begin)));
              });
  });
}

}  // namespace scotopic

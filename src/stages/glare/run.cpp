#include "stages/glare/run.h"

#include <algorithm>
#include <array>

namespace scotopic::glare {
namespace {

constexpr int band = 128;  // rows of a task

int borders_of(int height) { return (height + band - 1) / band - 1; }

std::ptrdiff_t rows_kept(const Ladder& ladder, int planes) {
  const Level& level = ladder.levels.front();
  return static_cast<std::ptrdiff_t>(borders_of(level.height)) * 2 * level.reach() * planes + 1;
}

/// The power of two above `reach` rows on both sides.
int ring_size(int reach) { return reach < 8 ? 16 : 32; }

using RowPointers = std::array<float*, most_planes>;

/// Sum of the column taps that fall inside the picture around row y.
float column_of_ones(const HalfTaps& taps, int y, int height) {
  double sum = static_cast<double>(taps[0]);
  for (int d = 1; d < static_cast<int>(taps.size()); ++d)
    sum += static_cast<double>(taps[static_cast<std::size_t>(d)]) * ((y - d >= 0) + (y + d < height));
  return static_cast<float>(sum);
}

}  // namespace

/// The rows that a band is computed from, as it goes down.
struct Run::Window {
  Window(const Run& run, int band_begin, int band_end)
      : begin(band_begin),
        end(band_end),
        next(band_begin),
        size(ring_size(run.level().reach())),
        ring(run.level().width, static_cast<std::ptrdiff_t>(size) * run.planes()),
        blurred(run.level().width, run.planes()),
        scratch(run.level().width) {}
  float* row(int plane, int y) { return ring.row(static_cast<std::ptrdiff_t>(plane) * size + y % size); }
  const float* row(int plane, int y) const {
    return ring.row(static_cast<std::ptrdiff_t>(plane) * size + y % size);
  }

  int begin, end;
  int next;  ///< the first row not yet in the ring
  int size;
  Rows ring, blurred;
  Scratch scratch;
};

Run::Run(const Plan& plan, const GlarePicture& picture, const Excess& excess)
    : plan_(plan),
      picture_(picture),
      excess_(excess),
      pyramid_(plan.ladder, excess.planes + 1),
      sides_(plan.width(), rows_kept(plan.ladder, excess.planes + 1)),
      ones_(plan.width(), most_rungs + 1) {}

std::size_t Run::bytes(const Plan& plan, int light, int threads) {
  const int planes = light + 1, reach = plan.ladder.levels.front().reach();
  const auto own = static_cast<std::size_t>(threads) *
                   static_cast<std::size_t>((ring_size(reach) + 1) * planes + most_rungs + 1);
  const auto rows = own + static_cast<std::size_t>(rows_kept(plan.ladder, planes)) + most_rungs + 1;
  return Pyramid::bytes(plan.ladder, planes) +
         rows * static_cast<std::size_t>(row_floats(plan.width())) * sizeof(float);
}

void Run::apply(const ParallelFor& parallel_for) {
  pyramid_.build([this](int y, float* const* rows) { excess_row_at(y, rows); }, parallel_for);
  keep_sides(parallel_for);
  blur_ones();
  for_bands(level().height, band, parallel_for, [&](int, int begin, int end) { scatter_band(begin, end); });
}

void Run::excess_row_at(int y, float* const* out) {
  if (!excess_row(excess_, row_of(picture_, y), out, level().width)) all_finite_ = false;
  for (int p = 0; p < planes(); ++p) finish_row(out[p], level().width, 0, level().width, plan_.ladder.sides);
}

// Border b is above row (b + 1) band; kept are `reach` rows on each side of it.
void Run::keep_sides(const ParallelFor& parallel_for) {
  const int reach = level().reach();
  parallel_for(borders_of(level().height), [&](int b) {
    for (int i = 0; i < 2 * reach; ++i) {
      const int y = (b + 1) * band - reach + i;
      if (y >= level().height) break;
      RowPointers rows{};
      for (int p = 0; p < planes(); ++p)
        rows[static_cast<std::size_t>(p)] =
            sides_.row(1 + (static_cast<std::ptrdiff_t>(b) * 2 * reach + i) * planes() + p);
      excess_row_at(y, rows.data());
    }
  });
}

const float* Run::row_at(const Window& window, int plane, int y) const {
  if (y < 0 || y >= level().height) return sides_.row(0);
  if (y >= window.begin && y < window.end) return window.row(plane, y);
  const int reach = level().reach(), b = (y < window.begin ? window.begin : window.end) / band - 1;
  const int i = y - ((b + 1) * band - reach);
  return sides_.row(1 + (static_cast<std::ptrdiff_t>(b) * 2 * reach + i) * planes() + plane);
}

// Where all pixels are finite the mask is a row of ones times a column of ones, and so is each rung of it.
void Run::blur_ones() {
  if (!all_finite_) return;
  const int width = level().width;
  float* const row = ones_.row(most_rungs);
  std::fill_n(row, width, 1.0f);
  finish_row(row, width, 0, width, plan_.ladder.sides);
  for (std::size_t r = 0; r < level().rungs.size(); ++r) {
    Level one = level();
    one.rungs = {level().rungs[r]};
    const float* const in[1] = {row};
    blur_row_add(one, in, ones_.row(static_cast<std::ptrdiff_t>(r)), 0, width);
  }
}

void Run::advance(Window& window, int to) {
  for (; window.next <= std::min(to, window.end - 1); ++window.next) {
    RowPointers rows{};
    for (int p = 0; p < planes(); ++p) rows[static_cast<std::size_t>(p)] = window.row(p, window.next);
    excess_row_at(window.next, rows.data());
  }
}

void Run::blur_row(Window& window, int plane, int y) const {
  const int reach = level().reach();
  std::array<const float*, 64> rows{};
  for (int d = -reach; d <= reach; ++d)
    rows[static_cast<std::size_t>(reach + d)] = row_at(window, plane, y + d);
  float* const out = window.blurred.row(plane);
  pyramid_.coarse_row(plane, y, window.scratch, out);
  add_rungs(level(), rows.data(), 0, level().width, window.scratch, out);
}

void Run::blur_mask_of_ones(Window& window, int y) const {
  float* const out = window.blurred.row(mask());
  pyramid_.coarse_row(mask(), y, window.scratch, out);
  for (std::size_t r = 0; r < level().rungs.size(); ++r)
    add_scaled(ones_.row(static_cast<std::ptrdiff_t>(r)),
               column_of_ones(level().rungs[r].y, y, level().height), out, level().width);
}

void Run::scatter_band(int begin, int end) {
  Window window(*this, begin, end);
  for (int y = begin; y < end; ++y) {
    advance(window, y + level().reach());
    for (int p = 0; p < excess_.planes; ++p) blur_row(window, p, y);
    if (all_finite_)
      blur_mask_of_ones(window, y);
    else
      blur_row(window, mask(), y);
    std::array<const float*, most_planes> own{}, come{};
    for (int p = 0; p < planes(); ++p) {
      own[static_cast<std::size_t>(p)] = window.row(p, y);
      come[static_cast<std::size_t>(p)] = window.blurred.row(p);
    }
    scatter_row(excess_, row_of(picture_, y), own.data(), come.data(), level().width);
  }
}

}  // namespace scotopic::glare

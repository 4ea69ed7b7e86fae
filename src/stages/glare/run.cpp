#include "stages/glare/run.h"

#include <algorithm>
#include <array>

#include "stages/glare/pyramid/coarse_rows.h"

namespace scotopic::glare {
namespace {

constexpr int band = 128;  // rows of a task
// Rows that are made of one plane before the next is looked at: the rows around them stay in the processor's
// cache, where those of all planes of a wide picture do not.
constexpr int block = 4;

int borders_of(int height) { return (height + band - 1) / band - 1; }

std::ptrdiff_t rows_kept(const Ladder& ladder, int planes) {
  const Level& level = ladder.levels.front();
  return static_cast<std::ptrdiff_t>(borders_of(level.height)) * 2 * level.reach() * planes + 1;
}

/// The power of two that holds a block and `reach` rows on both sides.
int ring_size(int reach) { return 2 * reach + block <= 16 ? 16 : 32; }

using RowPointers = std::array<float*, most_planes>;

/// Sum of the column taps that fall inside the picture around row y.
float column_of_ones(const HalfTaps& taps, int y, int height) {
  double sum = static_cast<double>(taps[0]);
  for (int d = 1; d < static_cast<int>(taps.size()); ++d)
    sum += static_cast<double>(taps[static_cast<std::size_t>(d)]) * ((y - d >= 0) + (y + d < height));
  return static_cast<float>(sum);
}

/// To the steps beside lit ones: a rung reaches less than a step to either side, elsewhere it would add
/// zeros.
void widen(std::vector<std::uint8_t>& lit, bool meet) {
  const std::size_t steps = lit.size();
  if (steps == 1) return;
  const std::uint8_t first = lit[0], next_to_last = lit[steps - 2], last = lit[steps - 1];
  for (std::size_t i = 0, left = 0; i < steps; ++i) {
    const std::uint8_t own = lit[i], right = i + 1 < steps ? lit[i + 1] : std::uint8_t{0};
    lit[i] = static_cast<std::uint8_t>(left | own | right);
    left = own;
  }
  if (!meet) return;
  // The last step may be narrower than a rung reaches, which then ends in the one beyond.
  lit[0] |= last | next_to_last;
  lit[steps - 2] |= first;
  lit[steps - 1] |= first;
}

}  // namespace

/// The rows that a band is computed from, as it goes down.
struct Run::Window {
  Window(const Run& run, int band_begin, int band_end)
      : begin(band_begin),
        end(band_end),
        next(band_begin),
        size(ring_size(run.level().reach())),
        of_ones(run.all_finite_ ? run.mask() : -1),
        steps(static_cast<std::size_t>(run.steps())),
        ring(run.level().width, static_cast<std::ptrdiff_t>(size) * run.planes()),
        ring_lit(static_cast<std::size_t>(size) * steps),
        lit(block, std::vector<std::uint8_t>(steps)),
        blurred(run.level().width, block * (run.planes() + run.rings())),
        coarse(run.pyramid_),
        scratch(run.level().width) {}
  float* row(int plane, int y) { return ring.row(place(plane, y)); }
  const float* row(int plane, int y) const { return ring.row(place(plane, y)); }
  std::ptrdiff_t place(int plane, int y) const {
    return static_cast<std::ptrdiff_t>(plane) * size + (plane == of_ones ? 0 : y % size);
  }
  float* blurred_row(int plane, int y) { return blurred.row(plane * block + (y - begin) % block); }
  std::vector<std::uint8_t>& lit_around(int y) { return lit[static_cast<std::size_t>((y - begin) % block)]; }
  std::uint8_t* row_lit(int y) { return ring_lit.data() + static_cast<std::size_t>(y % size) * steps; }
  const std::uint8_t* row_lit(int y) const {
    return ring_lit.data() + static_cast<std::size_t>(y % size) * steps;
  }

  int begin, end;
  int next;  ///< the first row not yet in the ring
  int size;
  int of_ones;  ///< the plane whose rows are all alike: a mask of ones
  std::size_t steps;
  Rows ring;
  std::vector<std::uint8_t> ring_lit;
  std::vector<std::vector<std::uint8_t>> lit;  ///< where a row of the block has a lit sample within reach
  Rows blurred;                                ///< of each plane a block
  CoarseRows coarse;
  Scratch scratch;
};

Run::Run(const Plan& plan, const GlarePicture& picture, const Excess& excess)
    : plan_(plan),
      picture_(picture),
      excess_(excess),
      pyramid_(plan.ladder, excess.planes + 1),
      sides_(plan.width(), rows_kept(plan.ladder, excess.planes + 1)),
      sides_lit_(static_cast<std::size_t>(rows_kept(plan.ladder, 1)) * static_cast<std::size_t>(steps())),
      ones_(plan.width(), most_rungs + 1) {}

std::size_t Run::bytes(const Plan& plan, int light, int threads) {
  const int planes = light + 1, reach = plan.ladder.levels.front().reach();
  const auto own = static_cast<std::size_t>(threads) *
                   static_cast<std::size_t>((ring_size(reach) + block) * planes +
                                            block * Pyramid::rings(plan.ladder, planes) + most_rungs + 1);
  const auto rows = own + static_cast<std::size_t>(rows_kept(plan.ladder, planes)) + most_rungs + 1;
  return Pyramid::bytes(plan.ladder, planes) +
         static_cast<std::size_t>(threads) * CoarseRows::bytes(plan.ladder, planes) +
         rows * static_cast<std::size_t>(row_floats(plan.width())) * sizeof(float);
}

void Run::apply(const ParallelFor& parallel_for) {
  const auto source = [this](int y, float* const* rows) {
    thread_local std::vector<std::uint8_t> lit;
    lit.resize(static_cast<std::size_t>(steps()));
    return excess_row_at(y, rows, lit.data());
  };
  pyramid_.build(source, parallel_for);
  keep_sides(parallel_for);
  blur_ones();
  for_bands(level().height, band, parallel_for, [&](int, int begin, int end) { scatter_band(begin, end); });
}

bool Run::excess_row_at(int y, float* const* out, std::uint8_t* lit) {
  const bool finite = excess_row(excess_, row_of(picture_, y), out, lit, level().width);
  if (!finite) all_finite_ = false;
  for (int p = 0; p < planes(); ++p) finish_row(out[p], level().width, 0, level().width, plan_.ladder.sides);
  return finite;
}

// Border b is above row (b + 1) band; kept are `reach` rows on each side of it.
void Run::keep_sides(const ParallelFor& parallel_for) {
  const int reach = level().reach();
  parallel_for(borders_of(level().height), [&](int b) {
    for (int i = 0; i < 2 * reach; ++i) {
      const int y = (b + 1) * band - reach + i;
      if (y >= level().height) break;
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(b) * 2 * reach + i;
      RowPointers rows{};
      for (int p = 0; p < planes(); ++p)
        rows[static_cast<std::size_t>(p)] = sides_.row(1 + at * planes() + p);
      excess_row_at(y, rows.data(), sides_lit_.data() + at * steps());
    }
  });
}

std::ptrdiff_t Run::kept(const Window& window, int y) const {
  const int reach = level().reach(), border = y < window.begin ? window.begin : window.end;
  return static_cast<std::ptrdiff_t>(border / band - 1) * 2 * reach + y - (border - reach);
}

const float* Run::row_at(const Window& window, int plane, int y) const {
  if (y < 0 || y >= level().height) return sides_.row(0);
  if (y >= window.begin && y < window.end) return window.row(plane, y);
  return sides_.row(1 + kept(window, y) * planes() + plane);
}

const std::uint8_t* Run::lit_at(const Window& window, int y) const {
  if (y >= window.begin && y < window.end) return window.row_lit(y);
  return sides_lit_.data() + kept(window, y) * steps();
}

void Run::see_lit(Window& window, int y) const {
  std::vector<std::uint8_t>& lit = window.lit_around(y);
  std::fill(lit.begin(), lit.end(), std::uint8_t{0});
  for (int j = std::max(0, y - level().reach()); j <= std::min(y + level().reach(), level().height - 1);
       ++j) {
    const std::uint8_t* const row = lit_at(window, j);
    for (std::size_t i = 0; i < lit.size(); ++i) lit[i] |= row[i];
  }
  widen(lit, plan_.ladder.sides == GlareSides::meet);
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
    float* const out = ones_.row(static_cast<std::ptrdiff_t>(r));
    std::fill_n(out, width, 0.0f);
    blur_row_add(one, in, out, 0, width);
  }
}

void Run::advance(Window& window, int to) {
  for (; window.next <= std::min(to, window.end - 1); ++window.next) {
    RowPointers rows{};
    for (int p = 0; p < planes(); ++p) rows[static_cast<std::size_t>(p)] = window.row(p, window.next);
    excess_row_at(window.next, rows.data(), window.row_lit(window.next));
  }
}

void Run::blur_row(Window& window, int plane, int y) const {
  if (plane >= planes()) return window.coarse.row(plane, y, window.scratch, window.blurred_row(plane, y));
  if (plane == mask() && all_finite_) return blur_mask_of_ones(window, y);
  const std::vector<std::uint8_t>& lit = window.lit_around(y);
  const int reach = level().reach();
  std::array<const float*, 64> rows{};
  for (int d = -reach; d <= reach; ++d)
    rows[static_cast<std::size_t>(reach + d)] = row_at(window, plane, y + d);
  float* const out = window.blurred_row(plane, y);
  window.coarse.row(plane, y, window.scratch, out);
  for (std::size_t i = 0; i < lit.size();) {
    const std::size_t begin = i;
    while (i < lit.size() && (plane == mask() || lit[i] != 0)) ++i;
    if (i == begin) {
      ++i;
      continue;
    }
    add_rungs(level(), rows.data(), static_cast<int>(begin) * lit_step,
              std::min(static_cast<int>(i) * lit_step, level().width), window.scratch, out);
  }
}

void Run::blur_mask_of_ones(Window& window, int y) const {
  float* const out = window.blurred_row(mask(), y);
  window.coarse.row(mask(), y, window.scratch, out);
  for (std::size_t r = 0; r < level().rungs.size(); ++r)
    add_scaled(ones_.row(static_cast<std::ptrdiff_t>(r)),
               column_of_ones(level().rungs[r].y, y, level().height), out, level().width);
}

void Run::scatter(Window& window, int y) const {
  std::array<const float*, most_planes> own{};
  std::array<const float*, most_planes + most_light> come{};
  for (int p = 0; p < planes(); ++p) own[static_cast<std::size_t>(p)] = window.row(p, y);
  for (int p = 0; p < planes() + rings(); ++p) come[static_cast<std::size_t>(p)] = window.blurred_row(p, y);
  scatter_row(excess_, row_of(picture_, y), own.data(), come.data(), level().width);
}

void Run::scatter_band(int begin, int end) {
  Window window(*this, begin, end);
  for (int first = begin; first < end; first += block) {
    const int last = std::min(first + block, end) - 1;
    advance(window, last + level().reach());
    for (int y = first; y <= last; ++y) see_lit(window, y);
    for (int p = 0; p < planes() + rings(); ++p)
      for (int y = first; y <= last; ++y) blur_row(window, p, y);
    for (int y = first; y <= last; ++y) scatter(window, y);
  }
}

}  // namespace scotopic::glare

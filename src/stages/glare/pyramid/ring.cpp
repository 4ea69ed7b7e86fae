#include "stages/glare/pyramid/ring.h"

#include <algorithm>

namespace scotopic::glare {
namespace {

int pad_of(const Halo& halo) { return std::max(halo.reach, 2 * halo.wide); }

std::size_t rows_of(const Level& level, const Halo& halo, int planes) {
  return static_cast<std::size_t>(planes) *
         static_cast<std::size_t>(level.y_end - level.y_begin + 2 * halo.wide);
}

}  // namespace

RingPlanes::RingPlanes(const Level& level, const Halo& halo, int planes)
    : level_(level),
      halo_(halo),
      spread_(level),
      pad_(pad_of(halo)),
      rows_(level.width + 2 * pad_, static_cast<std::ptrdiff_t>(rows_of(level, halo, planes)) + 1),
      lit_(rows_of(level, halo, planes)) {
  spread_.rungs = {halo.spread};
}

std::size_t RingPlanes::bytes(const Level& level, const Halo& halo, int planes) {
  return (rows_of(level, halo, planes) + 1) *
         (static_cast<std::size_t>(row_floats(level.width + 2 * pad_of(halo))) * sizeof(float) + 1);
}

/// What is beyond samples begin ... end - 1: zeros, or the panorama's other side.
void RingPlanes::fill_around(float* row, int begin, int end, GlareSides sides) const {
  float* const first = row - pad_ - before;
  float* const last = first + rows_.stride();
  if (sides == GlareSides::end) {
    std::fill(first, row + begin, 0.0f);
    std::fill(row + end, last, 0.0f);
    return;
  }
  const int width = level_.width;
  for (int i = 1; i <= pad_ + before; ++i) row[-i] = row[(width - i % width) % width];
  for (float* to = row + width; to < last; ++to) *to = to[-width];
}

void RingPlanes::take(int plane, int y, const float* const* rows, GlareSides sides) {
  Rows own(level_.width + 2 * pad_, 3);
  float* const columns[1] = {own.row(1)};
  const int steps = (level_.x_end + before + column_step - 1) / column_step;
  blur_columns(spread_, rows, columns, -before, steps * column_step - before);
  float* const in = own.row(2) + pad_;
  std::copy(columns[0] + level_.x_begin, columns[0] + level_.x_end, in + level_.x_begin);
  fill_around(in, level_.x_begin, level_.x_end, sides);

  const int beyond = sides == GlareSides::meet ? 0 : halo_.wide;
  const int begin = level_.x_begin - beyond, end = level_.x_end + beyond;
  float* const out = row(index(plane, y));
  const float* const input[1] = {in};
  std::fill(out + begin, out + end, 0.0f);
  blur_row_add(spread_, input, out, begin, end);
  fill_around(out, begin, end, sides);
  lit_[static_cast<std::size_t>(index(plane, y))] =
      std::any_of(out + begin, out + end, [](float x) { return x != 0; });
}

void RingPlanes::add(int plane, const Ring& ring, int y, float* out) const {
  for (const Arc& arc : ring.arcs) {
    const int from = y + arc.dy;
    if (from < y_begin() || from >= y_end()) continue;
    const std::ptrdiff_t at = index(plane, from);
    if (lit_[static_cast<std::size_t>(at)] != 0)
      correlate_add(row(at) + arc.dx, arc.weights, out, level_.x_begin, level_.x_end);
  }
}

}  // namespace scotopic::glare

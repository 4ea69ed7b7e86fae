#include "stages/glare/pyramid/coarse_rows.h"

#include <algorithm>

namespace scotopic::glare {

CoarseRows::CoarseRows(const Pyramid& pyramid)
    : pyramid_(pyramid),
      rows_(pyramid.ladder().levels[1].width, last_rows * pyramid.blurred_planes()),
      next_(static_cast<std::size_t>(pyramid.blurred_planes()), pyramid.ladder().levels[1].y_begin) {}

std::size_t CoarseRows::bytes(const Ladder& ladder, int planes) {
  const auto rows = static_cast<std::size_t>(last_rows * (planes + Pyramid::rings(ladder, planes)));
  return rows * static_cast<std::size_t>(row_floats(ladder.levels[1].width)) * sizeof(float);
}

void CoarseRows::advance(int plane, int from, int to, Scratch& scratch) {
  int& next = next_[static_cast<std::size_t>(plane)];
  for (next = std::max(next, from); next <= to; ++next)
    pyramid_.blurred_row(plane, next, scratch, at(plane, next));
}

void CoarseRows::row(int plane, int y, Scratch& scratch, float* out) {
  const DoubledFrom from(y);
  advance(plane, from.rows[0], from.rows[2], scratch);
  const float* const rows[3] = {at(plane, from.rows[0]), at(plane, from.rows[1]), at(plane, from.rows[2])};
  const Ladder& ladder = pyramid_.ladder();
  double_rows(ladder.levels[1], ladder.levels[0], rows, from.odd, scratch, out);
}

}  // namespace scotopic::glare

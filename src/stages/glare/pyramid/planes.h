// What a level of the pyramid holds.
#pragma once

#include <cstddef>

#include "stages/glare/pyramid/ladder.h"
#include "stages/glare/pyramid/rows.h"

namespace scotopic::glare {

/// Rows of every plane of a level, margin included.
class Planes {
 public:
  /// The rows beyond the margin are 0, the others hold anything.
  Planes(const Level& level, int planes)
      : begin_(level.y_begin), end_(level.y_end), rows_(level.width, rows_of(level, planes)) {}
  /// Row y of a plane; rows beyond the margin are 0.
  float* row(int plane, int y) { return rows_.row(index(plane, y)); }
  /// The same, to read.
  const float* row(int plane, int y) const { return rows_.row(index(plane, y)); }

  /// What the constructor allocates.
  static std::size_t bytes(const Level& level, int planes) {
    return static_cast<std::size_t>(rows_of(level, planes) * row_floats(level.width)) * sizeof(float);
  }

 private:
  static std::ptrdiff_t rows_of(const Level& level, int planes) {
    return 1 + static_cast<std::ptrdiff_t>(planes) * (level.y_end - level.y_begin);
  }
  std::ptrdiff_t index(int plane, int y) const {
    if (y < begin_ || y >= end_) return 0;
    return 1 + static_cast<std::ptrdiff_t>(plane) * (end_ - begin_) + (y - begin_);
  }
  int begin_, end_;
  Rows rows_;
};

}  // namespace scotopic::glare

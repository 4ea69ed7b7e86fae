// What coarser levels say of the picture, row by row downwards.
#pragma once

#include <cstddef>
#include <vector>

#include "stages/glare/pyramid/pyramid.h"

namespace scotopic::glare {

/// Rows of level 0 from rows of level 1, which are blurred on the way and forgotten again: what is at work
/// stays in the processor's cache. One for each band of rows; pyramid must outlive it.
class CoarseRows {
 public:
  explicit CoarseRows(const Pyramid& pyramid);

  /// Row y of `plane` of level 0, samples 0 ... width - 1: y no less than in any call before for that plane.
  void row(int plane, int y, Scratch& scratch, float* out);

  /// What the constructor allocates.
  static std::size_t bytes(const Ladder& ladder, int planes);

 private:
  float* at(int plane, int y) { return rows_.row(plane * last_rows + (y & (last_rows - 1))); }
  void advance(int plane, int from, int to, Scratch& scratch);

  static constexpr int last_rows = 4;  ///< of each plane: doubling looks at three
  const Pyramid& pyramid_;
  Rows rows_;
  std::vector<int> next_;  ///< of each plane the first row of level 1 not yet here
};

}  // namespace scotopic::glare

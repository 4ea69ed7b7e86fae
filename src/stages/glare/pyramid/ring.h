// The lens's halo on a level of the pyramid: a narrow Gaussian first, then a ring one sample thin, together a
// ring of the right width. Rings are few samples in a large square, so they are summed arc by arc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stages/glare/pyramid/ladder.h"
#include "stages/glare/pyramid/rows.h"

namespace scotopic::glare {

/// Planes of a level blurred by halo.spread, also where that reaches beyond the level: ring and blur together
/// are then symmetric. Level and halo must outlive it.
class RingPlanes {
 public:
  /// Room for `planes` planes of the level.
  RingPlanes(const Level& level, const Halo& halo, int planes);
  /// What the constructor allocates.
  static std::size_t bytes(const Level& level, const Halo& halo, int planes);

  /// Rows that take() is to be called for.
  int y_begin() const { return level_.y_begin - halo_.wide; }
  int y_end() const { return level_.y_end + halo_.wide; }
  int reach() const { return spread_.reach(); }
  /// Makes row y of a plane from the level's rows around: rows[reach() + d] is d rows below. Any thread.
  void take(int plane, int y, const float* const* rows, GlareSides sides);
  /// out += what `ring` sends to row y from the plane; writes up to 15 floats more. Any thread.
  void add(int plane, const Ring& ring, int y, float* out) const;

 private:
  std::ptrdiff_t index(int plane, int y) const {
    return std::ptrdiff_t{plane} * (y_end() - y_begin()) + (y - y_begin());
  }
  float* row(std::ptrdiff_t index) { return rows_.row(1 + index) + pad_; }
  const float* row(std::ptrdiff_t index) const { return rows_.row(1 + index) + pad_; }
  void fill_around(float* row, int begin, int end, GlareSides sides) const;

  const Level& level_;
  const Halo& halo_;
  Level spread_;  ///< the level with halo.spread as its only rung
  int pad_;       ///< samples to both sides of a row
  Rows rows_;
  std::vector<std::uint8_t> lit_;  ///< of each row, whether it has anything but zeros
};

}  // namespace scotopic::glare

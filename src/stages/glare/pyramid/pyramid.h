// A symmetric pyramid with no negative weight, which convolves planes with the Gaussians of a ladder. Halving
// a level, blurring what is left and doubling by the transpose of the halving: weights y -> x and x -> y are
// one, so light is conserved, and sums of positive numbers need no more than float over any range.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "stages/glare/pyramid/ladder.h"
#include "stages/glare/pyramid/planes.h"
#include "stages/glare/pyramid/ring.h"
#include "stages/glare/pyramid/rows.h"
#include "stages/shared/parallel_for.h"

namespace scotopic::glare {

/// Rows that one task works in.
struct Scratch {
  /// For levels up to `width` wide.
  explicit Scratch(int width) : rows(width, most_rungs + 1) {}
  Rows rows;
};

/// Levels 1 ... L of the planes of one picture: first what they hold, then, but for level 1, what that is
/// blurred to. Where the ladder has a halo, the last plane is a mask, and each other has its ring: added to
/// what it is blurred to, and of the mask a plane more, `planes` + that plane's number.
class Pyramid {
 public:
  /// Fills row y of level 0, plane by plane, finished (finish_row). Whether the last plane is a mask that is
  /// 1 all along the row.
  using RowSource = std::function<bool(int y, float* const* rows)>;

  /// Keeps a reference to the ladder.
  Pyramid(const Ladder& ladder, int planes);

  /// Computes all levels but 0. Calls source from several threads, for the same row more than once.
  void build(const RowSource& source, const ParallelFor& parallel_for);

  /// Row y, of the margin too, of what a plane of level 1 is blurred to: it is not kept, as it would be a
  /// quarter of the picture in memory.
  void blurred_row(int plane, int y, Scratch& scratch, float* out) const;

  /// Planes that blurred_row() has: those of the picture, and the mask's rings.
  int blurred_planes() const { return planes_ + rings(); }
  /// See there.
  const Ladder& ladder() const { return ladder_; }

  /// Planes of the mask's rings: 0 without a halo.
  static int rings(const Ladder& ladder, int planes) { return ladder.halo.level > 0 ? planes - 1 : 0; }

  /// What the constructor allocates.
  static std::size_t bytes(const Ladder& ladder, int planes);

 private:
  int rings() const { return rings(ladder_, planes_); }
  static int kept(const Ladder& ladder, int planes, int j);
  void make_ones();
  void spread_halo(const ParallelFor& parallel_for);
  void add_halo(int j, int plane, int y, float* out) const;
  void ring_mask_row(int j, int ring, int y, Scratch& scratch, float* out) const;
  int blurred_planes(int j) const { return planes_ + (j <= ladder_.halo.level ? rings() : 0); }
  void halve_picture(const RowSource& source, const ParallelFor& parallel_for);
  void halve_level(int j, const ParallelFor& parallel_for);
  void sum_top(const ParallelFor& parallel_for);
  void blur_level(int j, const ParallelFor& parallel_for);
  void add_sharp(int j, int plane, int y, Scratch& scratch, float* out) const;
  void blurred_row(int j, int plane, int y, Scratch& scratch, float* out) const;
  void doubled_row(int j, int plane, int y, Scratch& scratch, float* out) const;

  const Level& level(int j) const { return ladder_.levels[static_cast<std::size_t>(j)]; }
  int last() const { return static_cast<int>(ladder_.levels.size()) - 1; }
  /// Level j >= 1 before and after blurring.
  Planes& sharp(int j) { return sharp_[static_cast<std::size_t>(j - 1)]; }
  const Planes& sharp(int j) const { return sharp_[static_cast<std::size_t>(j - 1)]; }
  const float* sharp_row(int j, int plane, int y) const {
    return j == 1 && of_ones(plane, y, 0) ? ones_.row(1) : sharp(j).row(plane, y);
  }
  bool of_ones(int plane, int y, int reach) const;
  Planes& blurred(int j) { return blurred_[static_cast<std::size_t>(j - 1)]; }
  const Planes& blurred(int j) const { return blurred_[static_cast<std::size_t>(j - 1)]; }

  const Ladder& ladder_;
  int planes_;
  std::vector<Planes> sharp_, blurred_;
  std::optional<RingPlanes> halo_;
  Rows ones_;                          ///< of level 1: 1 a row of a mask of ones, 2 what it is blurred to
  std::vector<std::uint8_t> of_ones_;  ///< of each row of level 1, whether ones_ stands for its mask
};

/// The three rows of the level above that row y is made from: from y/2 on where y is odd (the third is not
/// read), else from the one before it.
struct DoubledFrom {
  explicit DoubledFrom(int y) : odd((y & 1) != 0), rows{(y >> 1) - !odd, (y >> 1) + odd, (y >> 1) + 1} {}
  bool odd;
  int rows[3];
};

/// Row y of level `to` from those rows.
void double_rows(const Level& from, const Level& to, const float* const (&rows)[3], bool odd,
                 Scratch& scratch, float* out);

/// Adds the rungs of a level to out, begin <= x < end, from its rows around: rows[reach + d] is d rows below.
void add_rungs(const Level& level, const float* const* rows, int begin, int end, Scratch& scratch,
               float* out);

}  // namespace scotopic::glare

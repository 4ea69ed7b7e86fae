// One picture on its way through a filter; for the files of this room alone.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stages/glare/plan.h"
#include "stages/glare/pyramid/pyramid.h"

namespace scotopic::glare {

/// What the sides of bands take from each other, and what a mask of ones is blurred to.
class Run {
 public:
  /// Keeps references to plan and picture.
  Run(const Plan& plan, const GlarePicture& picture, const Excess& excess);

  /// Computes the picture's light in place.
  void apply(const ParallelFor& parallel_for);

  /// Memory it takes for `planes` planes of light on `threads` threads.
  static std::size_t bytes(const Plan& plan, int planes, int threads);

 private:
  struct Window;
  void keep_sides(const ParallelFor& parallel_for);
  void blur_ones();
  bool excess_row_at(int y, float* const* out, std::uint8_t* lit);
  const float* row_at(const Window& window, int plane, int y) const;
  const std::uint8_t* lit_at(const Window& window, int y) const;
  void see_lit(Window& window, int y) const;
  void advance(Window& window, int to);
  void blur_row(Window& window, int plane, int y) const;
  void blur_mask_of_ones(Window& window, int y) const;
  void scatter(Window& window, int y) const;
  void scatter_band(int begin, int end);

  /// How far into sides_ row y is that was kept for the window; in rows of the picture.
  std::ptrdiff_t kept(const Window& window, int y) const;
  int steps() const { return (plan_.width() + lit_step - 1) / lit_step; }
  int mask() const { return excess_.planes; }
  int planes() const { return excess_.planes + 1; }
  int rings() const { return Pyramid::rings(plan_.ladder, planes()); }
  const Level& level() const { return plan_.ladder.levels.front(); }

  const Plan& plan_;
  const GlarePicture& picture_;
  const Excess excess_;
  std::atomic<bool> all_finite_{true};
  Pyramid pyramid_;
  Rows sides_;  ///< rows around the borders of bands, as others write in place
  std::vector<std::uint8_t> sides_lit_;
  Rows ones_;  ///< rung by rung, a row of ones blurred
};

}  // namespace scotopic::glare

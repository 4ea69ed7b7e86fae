// A rectangle of samples of one level of the pyramid, with zeros around each row for vectors to run into.
#pragma once

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cstddef>
#include <new>

#include "stages/contrast/ranges.h"

namespace scotopic::contrast {

/// Zeros before and after the samples of a row: outside the picture there is no light.
inline constexpr int zeros_before = 16, zeros_after = 64;

/// Floats from row to row for `width` samples.
constexpr std::ptrdiff_t row_floats(int width) { return zeros_before + (width + 15) / 16 * 16 + zeros_after; }

class Plane {
 public:
  Plane() = default;
  Plane(Range x, Range y) {
    reshape(x, y);
    fill(0.0f);
  }

  /// Keeps its memory where that is enough. Samples are left as they are; around them are zeros.
  void reshape(Range x, Range y) {
    x_ = x;
    y_ = y;
    stride_ = row_floats(x.size());
    const auto floats = static_cast<std::size_t>(stride_ * y.size());
    if (floats > capacity_) allocate(floats);
    for (int i = y.begin; i < y.end; ++i) {
      std::fill(row(i) - zeros_before, row(i), 0.0f);
      std::fill(row(i) + x.size(), row(i) - zeros_before + stride_, 0.0f);
    }
  }
  void fill(float value) {
    for (int i = y_.begin; i < y_.end; ++i) std::fill_n(row(i), x_.size(), value);
  }

  Range x() const noexcept { return x_; }
  Range y() const noexcept { return y_; }
  int width() const noexcept { return x_.size(); }
  /// Sample x().begin of row `y`.
  float* row(int y) noexcept { return floats_.get() + (y - y_.begin) * stride_ + zeros_before; }
  const float* row(int y) const noexcept { return floats_.get() + (y - y_.begin) * stride_ + zeros_before; }
  /// The row's sample x.
  const float* at(int x, int y) const noexcept { return row(y) + (x - x_.begin); }

 private:
  void allocate(std::size_t floats) {
    floats_ = hwy::AllocateAligned<float>(floats);
    if (!floats_) throw std::bad_alloc();
    capacity_ = floats;
  }

  Range x_, y_;
  std::ptrdiff_t stride_ = 0;
  std::size_t capacity_ = 0;
  hwy::AlignedFreeUniquePtr<float[]> floats_;
};

}  // namespace scotopic::contrast

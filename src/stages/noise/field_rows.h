// The field along rows of pixels: what pixels share is computed once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "stages/noise/field.h"

namespace scotopic::noise {

/// Where pixels are in the field, and when. Directions are counted from the middle of the display window: the
/// field is the same for any crop, proxy or overscan of a picture.
struct View {
  double pixels_per_degree;  ///< > 0
  double center_x,
      center_y;    ///< middle of the display window: pixel x's own middle is (x + 1/2 - center_x)/ppd degrees
  double seconds;  ///< since the shot's frame 0
};

/// Columns x0 to x0 + width - 1 of a view. Keeps what rows next to each other share: one object per thread,
/// rows in any order (downwards is fastest). Each n is the double that field_at() gives, on every target, for
/// any columns and order.
class FieldRows {
 public:
  FieldRows(const Field& field, const View& view, std::int64_t x0, std::size_t width);
  ~FieldRows();
  FieldRows(FieldRows&&) noexcept;
  FieldRows& operator=(FieldRows&&) noexcept;

  /// Number of columns.
  std::size_t width() const noexcept;

  /// n of row y. They stay valid until the next call.
  const double* row(std::int64_t y);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scotopic::noise

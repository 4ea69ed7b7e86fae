// Rows of floats and what is done to them, vectorised: the same additions in the same order on every
// instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "stages/glare/pyramid/ladder.h"

namespace scotopic::glare {

/// Planes that scatter, at most, and the mask.
inline constexpr int most_light = 7;
inline constexpr int most_planes = most_light + 1;
/// Rungs of a level, at most: level 0 has one more for pixels that are not square.
inline constexpr int most_rungs = 5;

/// Rows that a rung is computed from, at most: its reach is below `before`.
inline constexpr int most_around = 2 * 16 + 1;

/// A row holds samples -before ... width + after - 1; what is beyond its level's samples is zero.
inline constexpr int before = 16;
inline constexpr int after = 96;

/// Floats from row to row of a level so wide.
constexpr std::ptrdiff_t row_floats(int width) { return (before + width + after + 31) / 32 * 32; }

/// Memory for rows. The first is 0, the others hold anything.
class Rows {
 public:
  Rows() = default;
  /// `count` rows of levels `width` wide.
  Rows(int width, std::ptrdiff_t count);
  /// Sample 0 of row i.
  float* row(std::ptrdiff_t i) { return floats_.get() + i * stride_ + before; }
  /// The same, to read.
  const float* row(std::ptrdiff_t i) const { return floats_.get() + i * stride_ + before; }
  /// Floats from row to row.
  std::ptrdiff_t stride() const { return stride_; }

 private:
  struct Free {
    void operator()(float* floats) const;
  };
  std::unique_ptr<float[], Free> floats_;
  std::ptrdiff_t stride_ = 0;
};

/// Zeroes what is beyond samples begin ... end - 1; in a panorama fills it from the other side.
void finish_row(float* row, int width, int begin, int end, GlareSides sides);

/// out = ([1 4 6 4 1]/16 down the columns of rows[0..4]), whole rows of `width`.
void halve_columns(const float* const (&rows)[5], float* out, int width);
/// The same along a row: out[k] is around in[2k], for begin <= k < end; writes up to 15 floats more.
void halve_row(const float* in, float* out, int begin, int end);

/// Row 2k (rows k-1, k, k+1) or 2k+1 (rows k, k+1; the third is not read) of the transpose, times two.
void double_columns(const float* const (&rows)[3], bool odd, float* out, int width);
/// The same along a row, to out[begin ... end-1]; writes up to 33 floats more on either side.
void double_row(const float* in, float* out, int begin, int end);

/// Columns are blurred in steps of so many samples.
inline constexpr int column_step = 32;
/// out[r] = rung r of `level` down the columns; rows[reach + d] is d rows below. Samples begin ... end - 1,
/// both multiples of column_step from -before on.
void blur_columns(const Level& level, const float* const* rows, float* const* out, int begin, int end);
/// out[x] += sum over rungs r of their blur along the row in[r], begin <= x < end; writes up to 15 floats
/// more.
void blur_row_add(const Level& level, const float* const* in, float* out, int begin, int end);

/// out[x] += the sum over i of weights[i] in[x + i], begin <= x < end; writes up to 15 floats more.
void correlate_add(const float* in, const std::vector<float>& weights, float* out, int begin, int end);

/// out += weight row, samples 0 ... width - 1.
void add_scaled(const float* row, float weight, float* out, int width);

}  // namespace scotopic::glare

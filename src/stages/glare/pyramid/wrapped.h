// Rows of panoramas whose width is odd, halved and doubled: w samples become (w + 1)/2, 2w/(w + 1) apart.
#pragma once

#include <array>
#include <vector>

namespace scotopic::glare {

/// A sample of the next level: of which six neighbours, from `first` on.
struct Wrapped {
  int first;
  std::array<float, 6> weights;
};

/// How a row of odd width is halved. Weights of a sample sum to 1; the transpose's are even to (1/width)^3.
std::vector<Wrapped> wrapped_of(int width);

/// The whole row; `in` is finished (finish_row).
void halve_row_around(const std::vector<Wrapped>& wrapped, const float* in, float* out);

/// The transpose, times the samples' distance: the whole row of `width`.
void double_row_around(const std::vector<Wrapped>& wrapped, const float* in, float* out, int width);

}  // namespace scotopic::glare

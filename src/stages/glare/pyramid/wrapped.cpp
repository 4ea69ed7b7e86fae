#include "stages/glare/pyramid/wrapped.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "stages/glare/pyramid/taps.h"

namespace scotopic::glare {
namespace {

// [1 4 6 4 1]/16 are the values of this quadratic B-spline at whole numbers: at any phase its values sum to 1
// and have the variance 1.
double halving(double t) {
  const double x = std::abs(t) / 2;
  return x < 0.5 ? (0.75 - x * x) / 2 : x < 1.5 ? squared(1.5 - x) / 4 : 0;
}

}  // namespace

// The transpose is even to (1/width)^3 because the spline's Fourier transform is sinc^3.
std::vector<Wrapped> wrapped_of(int width) {
  const int halved = (width + 1) / 2;
  std::vector<Wrapped> out;
  for (int k = 0; k < halved; ++k) {
    const double at = static_cast<double>(k) * width / halved;
    Wrapped one = {static_cast<int>(at) - 2, {}};
    for (std::size_t i = 0; i < 6; ++i)
      one.weights[i] = static_cast<float>(halving(one.first + static_cast<int>(i) - at));
    out.push_back(one);
  }
  return out;
}

void halve_row_around(const std::vector<Wrapped>& wrapped, const float* in, float* out) {
  for (const Wrapped& sample : wrapped) {
    float sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
      sum += sample.weights[i] * in[sample.first + static_cast<std::ptrdiff_t>(i)];
    *out++ = sum;
  }
}

void double_row_around(const std::vector<Wrapped>& wrapped, const float* in, float* out, int width) {
  const float distance = static_cast<float>(width) / static_cast<float>(wrapped.size());
  std::fill_n(out, width, 0.0f);
  for (const Wrapped& sample : wrapped) {
    const float value = distance * *in++;
    for (std::size_t i = 0; i < 6; ++i)
      out[(sample.first + static_cast<int>(i) + width) % width] += sample.weights[i] * value;
  }
}

}  // namespace scotopic::glare

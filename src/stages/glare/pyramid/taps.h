// Gaussians as taps, and what the pyramid itself blurs.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace scotopic::glare {

inline double squared(double x) { return x * x; }

/// Taps to each side of a Gaussian of sigma s.
inline int reach_of(double s) { return static_cast<int>(std::ceil(4 * s)); }

/// A Gaussian of sigma s samples: the middle's tap and those of one side; all taps sum to 1.
inline std::vector<double> sampled_taps(double s) {
  std::vector<double> taps;
  double sum = 0;
  for (int i = 0; i <= reach_of(s); ++i) {
    taps.push_back(std::exp(-i * i / (2 * s * s)));
    sum += (i == 0 ? 1 : 2) * taps.back();
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

/// As floats, each times `by`.
inline std::vector<float> scaled(const std::vector<double>& taps, double by) {
  std::vector<float> out;
  for (const double tap : taps) out.push_back(static_cast<float>(tap * by));
  return out;
}

}  // namespace scotopic::glare

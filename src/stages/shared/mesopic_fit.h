// The rods' share 1 - m of MES2 as a polynomial in log2 luminance: what a vector of pixels can evaluate.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "adaptation/mesopic.h"

namespace scotopic {

/// For a D65-like light (S/P 2.4648) between the two limits where m is neither 0 nor 1:
///   1 - m = v sum_k coefficient[k] v^k,   v = log2(high/L) / octaves in [0, 1].
/// The factor v keeps the share's own digits as it goes to 0 at the photopic limit, where shifts are many
/// times a dark pixel's light. Chebyshev interpolation of mesopic_coefficient(), which is analytic well
/// beyond the interval: |error| < 2e-8 at degree 7, < 1e-14 at degree 17 (tests/appearance). With the batch's
/// own logarithm, what is left of a light that rods do not see, m/(m + (1-m) rho C), is right to 4 ulp of 1
/// in float, and to 1.5 ulp with double inside and a float out, for every float from 1e-20 to 5 cd/m2
/// (tests/properties).
template <std::size_t Degree>
struct MesopicFit {
  double high = mesopic_photopic_limit();
  double octaves = std::log2(mesopic_photopic_limit() / mesopic_scotopic_limit());
  std::array<double, Degree + 1> coefficient{};

  MesopicFit() {
    constexpr std::size_t n = Degree + 1;
    std::array<double, n> chebyshev{};
    for (std::size_t node = 0; node < n; ++node) {
      const double angle = std::numbers::pi * (static_cast<double>(node) + 0.5) / n;
      const double v = (1 + std::cos(angle)) / 2;
      const double share = (1 - mesopic_coefficient(high * std::exp2(-octaves * v))) / v;
      for (std::size_t k = 0; k < n; ++k)
        chebyshev[k] += (k == 0 ? 1.0 : 2.0) / n * share * std::cos(static_cast<double>(k) * angle);
    }
    to_monomials(chebyshev);
  }

 private:
  // Shifted Chebyshev polynomials: T*_(k+1) = 2 (2v - 1) T*_k - T*_(k-1).
  void to_monomials(const std::array<double, Degree + 1>& chebyshev) {
    std::array<double, Degree + 1> before{1}, now{-1, 2};
    coefficient[0] = chebyshev[0];
    for (std::size_t k = 1; k <= Degree; ++k) {
      std::array<double, Degree + 1> next{};
      for (std::size_t i = 0; i <= Degree; ++i) {
        coefficient[i] += chebyshev[k] * now[i];
        next[i] -= before[i] + 2 * now[i];
        if (i < Degree) next[i + 1] += 4 * now[i];
      }
      before = now;
      now = next;
    }
  }
};

}  // namespace scotopic

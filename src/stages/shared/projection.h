// The nearest colour a gamut can show (Kirk & O'Brien 2011, equations 14-15: nearest in LMS).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "kernel/matrix3.h"

namespace scotopic {

/// argmin |M p - q| over p_i >= b_i, where M takes the gamut's linear RGB to LMS; b = 0 but for components
/// that came in negative, which may stay so. With z = p - b this is least squares over z >= 0, solved by
/// enumerating which components sit at 0. For each such active set the free components move linearly with
/// the bound ones: z_F += free_from_bound z_A, and the bound ones' multipliers are  -schur z_A.
template <typename T>
class GamutProjection {
 public:
  static constexpr std::size_t active_sets = 8;

  /// Row i of `primal` gives z_i of the set's solution from the unconstrained z (a bound component's row is
  /// 0); row i of `dual` gives the multiplier of bound component i (a free component's row is 0).
  struct ActiveSet {
    Matrix3<T> primal;
    Matrix3<T> dual;
  };

  /// `lms_from_gamut`: LMS from the gamut's linear RGB; invertible.
  explicit GamutProjection(const Matrix3<double>& lms_from_gamut) {
    for (unsigned set = 0; set < active_sets; ++set) {
      const auto solved = solve(transpose(lms_from_gamut) * lms_from_gamut, set);
      sets_[set] = {solved.primal.template to<T>(), solved.dual.template to<T>()};
    }
  }

  /// Set `i`: bit k says that component k sits at its bound.
  const ActiveSet& set(std::size_t i) const noexcept { return sets_[i]; }

  /// z >= 0 nearest to `z`; returns z itself, bit for bit, when it is already there. Continuous (C0),
  /// homogeneous of degree 1, never expands distances in LMS.
  Vec3<T> nearest(const Vec3<T>& z) const noexcept {
    if (z[0] >= 0 && z[1] >= 0 && z[2] >= 0) return z;
    Vec3<T> best{};
    T best_margin = -std::numeric_limits<T>::infinity();
    for (unsigned set = 1; set < active_sets; ++set) {
      const Vec3<T> primal = sets_[set].primal * z;
      const Vec3<T> dual = sets_[set].dual * z;
      // Exactly one set has primal and dual >= 0 (to rounding): the one whose worst entry is greatest.
      T margin = std::numeric_limits<T>::infinity();
      for (std::size_t i = 0; i < 3; ++i) margin = std::min(margin, (set >> i & 1u) ? dual[i] : primal[i]);
      if (margin > best_margin) {
        best_margin = margin;
        best = primal;
      }
    }
    for (auto& x : best) x = std::max(T(0), x);
    return best;
  }

 private:
  struct Solved {
    Matrix3<double> primal, dual;
  };

  // Bit i of `set`: component i is at its bound.
  static Solved solve(const Matrix3<double>& gram, unsigned set) {
    const auto bound = [set](std::size_t i) { return (set >> i & 1u) != 0; };
    // Gram matrix with bound rows and columns cut out (identity there), so that one inverse serves all sets.
    Matrix3<double> free = identity3<double>();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (!bound(i) && !bound(j)) free[i][j] = gram[i][j];
    const Matrix3<double> free_inverse = inverse(free);
    Matrix3<double> coupling{};  // gram between free rows and bound columns
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (!bound(i) && bound(j)) coupling[i][j] = gram[i][j];
    Matrix3<double> primal = free_inverse * coupling;
    for (std::size_t i = 0; i < 3; ++i) {
      if (bound(i))
        primal[i] = {0, 0, 0};
      else
        primal[i][i] += 1;
    }
    // Multipliers: gradient of the distance at the solution, gram (z* - z), on the bound components; scaled
    // by the diagonal so that primal and dual margins are in the same unit.
    Matrix3<double> step = primal;
    for (std::size_t i = 0; i < 3; ++i) step[i][i] -= 1;
    Matrix3<double> dual = gram * step;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) dual[i][j] = bound(i) && bound(j) ? dual[i][j] / gram[i][i] : 0.0;
    return {primal, dual};
  }

  std::array<ActiveSet, active_sets> sets_;
};

}  // namespace scotopic

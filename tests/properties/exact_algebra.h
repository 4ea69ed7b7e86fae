// Three-vectors and 3x3 matrices of the exact reference: its own, so that a fault of the product's would
// show.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace scotopic::test {

template <typename Real>
using Triple = std::array<Real, 3>;

/// Rows of a matrix that takes columns.
template <typename Real>
struct Square {
  std::array<Triple<Real>, 3> rows{};
  const Triple<Real>& operator[](std::size_t i) const { return rows[i]; }
  Triple<Real>& operator[](std::size_t i) { return rows[i]; }
};

template <typename Real>
Real inner(const Triple<Real>& a, const Triple<Real>& b) {
  Real sum(0);
  for (std::size_t i = 0; i < 3; ++i) sum += a[i] * b[i];
  return sum;
}

template <typename Real>
Triple<Real> plus(const Triple<Real>& a, const Triple<Real>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <typename Real>
Triple<Real> minus(const Triple<Real>& a, const Triple<Real>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <typename Real>
Triple<Real> times(const Real& s, const Triple<Real>& v) {
  return {s * v[0], s * v[1], s * v[2]};
}

template <typename Real>
Triple<Real> absolute(const Triple<Real>& v) {
  using std::abs;
  return {abs(v[0]), abs(v[1]), abs(v[2])};
}

template <typename Real>
Square<Real> absolute(const Square<Real>& m) {
  return {{absolute(m[0]), absolute(m[1]), absolute(m[2])}};
}

template <typename Real>
Triple<Real> operator*(const Square<Real>& m, const Triple<Real>& v) {
  return {inner(m[0], v), inner(m[1], v), inner(m[2], v)};
}

template <typename Real>
Square<Real> operator*(const Square<Real>& a, const Square<Real>& b) {
  Square<Real> out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += a[i][k] * b[k][j];
  return out;
}

template <typename Real>
Square<Real> operator*(const Real& s, const Square<Real>& m) {
  return {{times(s, m[0]), times(s, m[1]), times(s, m[2])}};
}

template <typename Real>
Square<Real> diagonal_of(const Triple<Real>& v) {
  Square<Real> out;
  for (std::size_t i = 0; i < 3; ++i) out[i][i] = v[i];
  return out;
}

template <typename Real>
Square<Real> transposed(const Square<Real>& m) {
  Square<Real> out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = m[j][i];
  return out;
}

/// The x of m x = right, by elimination with row pivots (the product goes by cofactors).
template <typename Real>
Triple<Real> solution(Square<Real> m, Triple<Real> right) {
  using std::abs;
  for (std::size_t i = 0; i < 3; ++i) {
    std::size_t pivot = i;
    for (std::size_t k = i + 1; k < 3; ++k)
      if (abs(m[k][i]) > abs(m[pivot][i])) pivot = k;
    std::swap(m[i], m[pivot]);
    std::swap(right[i], right[pivot]);
    for (std::size_t k = i + 1; k < 3; ++k) {
      const Real factor = m[k][i] / m[i][i];
      for (std::size_t j = i; j < 3; ++j) m[k][j] = m[k][j] - factor * m[i][j];
      right[k] = right[k] - factor * right[i];
    }
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t j = i + 1; j < 3; ++j) right[i] = right[i] - m[i][j] * right[j];
    right[i] = right[i] / m[i][i];
  }
  return right;
}

template <typename Real>
Square<Real> inverted(const Square<Real>& m) {
  Square<Real> rows_of_columns;
  for (std::size_t i = 0; i < 3; ++i) {
    Triple<Real> unit{Real(0), Real(0), Real(0)};
    unit[i] = Real(1);
    rows_of_columns[i] = solution(m, unit);
  }
  return transposed(rows_of_columns);
}

}  // namespace scotopic::test

// Three-vectors and 3x3 matrices over any number type: all the linear algebra colour needs.
#pragma once

#include <array>
#include <cstddef>

namespace scotopic {

/// Three components, whatever they are of.
template <typename T>
using Vec3 = std::array<T, 3>;

/// Row-major 3x3 matrix; `m[i]` is row i, so `m * v` takes column vectors.
template <typename T>
struct Matrix3 {
  std::array<Vec3<T>, 3> rows{};

  /// Row i.
  constexpr const Vec3<T>& operator[](std::size_t i) const { return rows[i]; }
  /// Row i, to be changed.
  constexpr Vec3<T>& operator[](std::size_t i) { return rows[i]; }

  /// The same matrix with every element rounded to another number type.
  template <typename U>
  constexpr Matrix3<U> to() const {
    Matrix3<U> out;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) out[i][j] = static_cast<U>(rows[i][j]);
    return out;
  }
};

/// a . b, summed from the left.
template <typename T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Matrix times column.
template <typename T>
constexpr Vec3<T> operator*(const Matrix3<T>& m, const Vec3<T>& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

/// Rows as columns.
template <typename T>
constexpr Matrix3<T> transpose(const Matrix3<T>& m) {
  return {{{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}}};
}

/// First b, then a.
template <typename T>
constexpr Matrix3<T> operator*(const Matrix3<T>& a, const Matrix3<T>& b) {
  const Matrix3<T> columns = transpose(b);
  Matrix3<T> out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = dot(a[i], columns[j]);
  return out;
}

/// Every element times s.
template <typename T>
constexpr Matrix3<T> operator*(T s, const Matrix3<T>& m) {
  Matrix3<T> out = m;
  for (auto& row : out.rows)
    for (auto& x : row) x *= s;
  return out;
}

/// d on the diagonal, zeros elsewhere.
template <typename T>
constexpr Matrix3<T> diagonal(const Vec3<T>& d) {
  return {{{{d[0], T(0), T(0)}, {T(0), d[1], T(0)}, {T(0), T(0), d[2]}}}};
}

/// 1.
template <typename T>
constexpr Matrix3<T> identity3() {
  return diagonal<T>({T(1), T(1), T(1)});
}

/// a x b.
template <typename T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Of the rows, as a triple product.
template <typename T>
constexpr T determinant(const Matrix3<T>& m) {
  return dot(m[0], cross(m[1], m[2]));
}

/// Inverse by cofactors; the caller vouches for determinant(m) != 0.
template <typename T>
constexpr Matrix3<T> inverse(const Matrix3<T>& m) {
  const T scale = T(1) / determinant(m);
  const Matrix3<T> cofactors{{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])}};
  return scale * transpose(cofactors);
}

}  // namespace scotopic

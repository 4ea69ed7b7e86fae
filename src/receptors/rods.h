// The rods' share of a colour whose spectrum is not known.
#pragma once

#include <array>

#include "kernel/matrix3.h"

namespace scotopic {

/// Scotopic over photopic luminance of CIE D65 (CIE 1951 V', CIE 1924 V; 380-780 nm in steps of 5 nm).
inline constexpr double sp_ratio_d65 = 2.4648;

/// S/P of monochromatic light of 650 nm, about the lowest that a surface or lamp reaches.
inline constexpr double sp_ratio_floor = 0.016;

/// Which fit: linear in XYZ, or with quadratic terms in chromaticity.
enum class RodEstimate { linear, quadratic };

/// Scotopic luminance from D65-adapted XYZ under D65. White-exact least squares over the reflectances of
/// Vrhel (170), Munsell (462) and Krinov (191), lit by daylights to tungsten.
inline constexpr Vec3<double> scotopic_linear_from_xyz = {-1.24550652, 2.40735814, 1.13998671};

/// The same fit with quadratic terms: (X+Y+Z) times these, of 1, x, y, x^2, xy, y^2.
inline constexpr std::array<double, 6> scotopic_quadratic_from_xy = {0.92170706, -3.50414354, 3.71453552,
                                                                     3.20585581, -4.58382815, -0.72925479};

namespace detail {

template <typename T>
constexpr T scotopic_linear(const Vec3<T>& xyz) noexcept {
  const auto& c = scotopic_linear_from_xyz;
  return dot(Vec3<T>{static_cast<T>(c[0]), static_cast<T>(c[1]), static_cast<T>(c[2])}, xyz);
}

// A chromaticity needs a positive sum: negative components, which no light has, count as 0. That keeps (x, y)
// inside the triangle the fit was made in, so the result is continuous and bounded everywhere.
template <typename T>
constexpr T scotopic_quadratic(const Vec3<T>& xyz) noexcept {
  const T zero = T(0);
  const T big_x = xyz[0] > zero ? xyz[0] : zero;
  const T big_y = xyz[1] > zero ? xyz[1] : zero;
  const T sum = big_x + big_y + (xyz[2] > zero ? xyz[2] : zero);
  if (!(sum > zero)) return zero;
  const T x = big_x / sum;
  const T y = big_y / sum;
  const auto& c = scotopic_quadratic_from_xy;
  return sum * (static_cast<T>(c[0]) + static_cast<T>(c[1]) * x + static_cast<T>(c[2]) * y +
                static_cast<T>(c[3]) * x * x + static_cast<T>(c[4]) * x * y + static_cast<T>(c[5]) * y * y);
}

}  // namespace detail

/// Scotopic luminance from a colour, in the unit of `xyz` (cd/m2 photopic in, cd/m2 scotopic out).
///
/// `xyz` is adapted to D65 (white .95047, 1, 1.08883), any scale. `sp_ratio` is that of the illuminant; the
/// estimate is homogeneous of degree 1 in `xyz`, and exact at white. Never below sp_ratio_floor * Y, hence
/// negative only where Y is; black gives 0; continuous; finite wherever X+Y+Z does not overflow.
/// Error over 723 real reflectances, illuminant known: 5-7 % on average (linear), 4-6 % (quadratic). A wrong
/// illuminant costs far more: +70 % if tungsten is taken for daylight, +280 % if it is sodium.
template <typename T>
constexpr T scotopic_luminance_from_xyz(const Vec3<T>& xyz, RodEstimate estimate, T sp_ratio) noexcept {
  const T d65 =
      estimate == RodEstimate::linear ? detail::scotopic_linear(xyz) : detail::scotopic_quadratic(xyz);
  const T scotopic = d65 * (sp_ratio / static_cast<T>(sp_ratio_d65));
  const T floor = static_cast<T>(sp_ratio_floor) * xyz[1];
  return scotopic > floor ? scotopic : floor;
}

}  // namespace scotopic

// How different two colours look: CIELAB, CIEDE2000, and the same for pixels of any brightness.
#pragma once

#include "kernel/matrix3.h"

namespace scotopic {

/// CIE 1976 L*, a*, b*.
struct Lab {
  double lightness = 0;
  double a = 0;
  double b = 0;
};

/// XYZ of D65 white, Y = 1, from x = .3127, y = .3290.
inline constexpr Vec3<double> d65_white = {0.3127 / 0.3290, 1.0, (1 - 0.3127 - 0.3290) / 0.3290};

/// CIE 1976 L*a*b* (ISO/CIE 11664-4) of an XYZ with Y = 1 for `white`. Its straight part goes on below 0, so
/// the result is continuous for every finite input. Lightness to 5 ulp of 1 or of itself.
Lab lab_from_xyz(const Vec3<double>& xyz, const Vec3<double>& white = d65_white) noexcept;

/// CIEDE2000 (ISO/CIE 11664-6; Sharma, Wu & Dalal, Color Res. Appl. 30, 2005), kL = kC = kH = 1. Symmetric;
/// to 1e-4 of the published test pairs.
double ciede2000(const Lab& a, const Lab& b) noexcept;

/// CIEDE2000 of two lights of a display whose white is Y = 1, as they are shown.
double shown_difference(const Vec3<double>& reference, const Vec3<double>& other) noexcept;

/// Delta E ITP (ITU-R BT.2124-0) of two lights, XYZ (D65) in units of 100 cd/m2: 720 times the distance in I,
/// T/2, P of ICtCp (BT.2100, PQ).
double itp_difference(const Vec3<double>& reference, const Vec3<double>& other) noexcept;

/// Luminance of a photographer's mid-grey, to which pixels are exposed before they are compared.
inline constexpr double exposed_luminance = 0.184;

/// CIEDE2000 of two D65-adapted XYZ after scaling both by what brings the reference's Y to exposed_luminance:
/// a dark pixel's error counts like a bright one's. Where the reference's Y is less than 1/64 of its largest
/// component, that takes Y's place; where the reference is black, the other colour is exposed instead. Both
/// black: 0. A component that is not finite: 0 if the bits of both agree in kind (both NaN, both the same
/// infinity), else infinity.
double exposed_difference(const Vec3<double>& reference, const Vec3<double>& other) noexcept;

}  // namespace scotopic

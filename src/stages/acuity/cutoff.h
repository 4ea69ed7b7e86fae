// How fine a detail the eye resolves when adapted to a luminance, and the blur that takes finer detail away.
#pragma once

namespace scotopic {

/// Highest resolvable spatial frequency, cycles per degree, at adaptation luminance `adaptation` (cd/m2):
/// 17.25 atan(1.4 log10 La + 0.35) + 25.72. Shlaer's 1937 measurements as fitted by Ward Larson, Rushmeier
/// and Piatko 1997 (A visibility matching tone reproduction operator, Eq. 12). La is floored at 1e-5 cd/m2,
/// where the fit still gives 1.2; a NaN counts as the floor. To 32 ulp: down there two
/// terms nearly cancel.
double acuity_cutoff(double adaptation) noexcept;

/// Standard deviation in pixels of the Gaussian whose transfer is 1/2 at acuity_cutoff(adaptation), i.e.
/// sqrt(2 ln 2)/(2 pi R) degrees = 0.1874/R degrees.
double acuity_sigma_pixels(double adaptation, double pixels_per_degree) noexcept;

/// Pixels per degree at the middle of an image `width_pixels` wide that a rectilinear lens shows under
/// `horizontal_fov_degrees` (0 < fov < 180).
double pixels_per_degree(double width_pixels, double horizontal_fov_degrees) noexcept;

/// True where an image of this angular resolution holds no frequency that the eye would lose: ppd/2 <= R(La).
bool acuity_is_not_limiting(double adaptation, double pixels_per_degree) noexcept;

}  // namespace scotopic

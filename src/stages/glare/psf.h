// How the eye spreads the light of a point: the CIE 135/1 total glare function (Vos and van den Berg 1999).
#pragma once

namespace scotopic {

/// Whose eye it is.
struct GlareEye {
  double age = 28.58;         ///< years, 0 ... 100; measured on eyes of 20 ... 80
  double pigmentation = 0.5;  ///< 0 black, 0.5 brown, 1 blue, 1.2 very light; 0 ... 1.2
  double halo = 0;            ///< share of the light that the lens spreads in a ring, 0 ... below 1 (halo.h)
};

/// The function over its integral over the hemisphere: one lux at the eye gives a veil of psf(theta) cd/m2.
/// All but the lens's halo, whose share is missing here.
/// Achromatic and independent of the pupil: past 0.1 degrees IJspeert's measured tail changes by 5 % from 3
/// to 7 mm.
class GlareFunction {
 public:
  /// Throws std::invalid_argument where age or pigmentation is outside its domain.
  explicit GlareFunction(const GlareEye& eye);

  /// 1/sr at `theta` degrees from the source, 0 ... 90: finite at 0, decreasing.
  double psf(double theta) const noexcept;

  /// What the function is divided by: its integral over the 2 pi sr of the hemisphere, over what is no halo.
  double normalisation() const noexcept { return normalisation_; }

  /// Share of the light in the lens's halo.
  double halo() const noexcept { return halo_; }

  /// The function as a sum of Gaussians whose sigmas are octaves apart,
  ///   psf(theta) ~ sum_j rung(sigma_0 2^j) exp(-theta^2 / 2 (sigma_0 2^j)^2) + wide(theta),
  /// for any sigma_0. Each term C (1 + (theta/c)^2)^-nu is an integral of Gaussians over ln sigma; this is
  /// its trapezoid rule. Relative error <= 2 |Gamma(nu + 2 pi i/(2 ln 2))|/Gamma(nu): 0.0208 at most (nu
  /// = 1.5). 1/sr for sigma in degrees, > 0.
  double rung(double sigma) const noexcept;

  /// What is no sum of Gaussians: the flat light through the wall of the eye and the rise towards 90 degrees.
  /// 1/sr.
  double wide(double theta) const noexcept;

 private:
  double core_;  ///< 1 - 0.08 (age/70)^4: what clouding takes from the peak
  double veil_;  ///< 1 + 1.6 (age/70)^4: what it adds around
  double pigmentation_;
  double halo_;
  double normalisation_;
};

/// Veil over illuminance, 1/sr, of CIE 146:2002's general disability glare equation; 0.1 ... 100 degrees. For
/// comparison: within 32 % of psf.
double cie146_veil(double theta, const GlareEye& eye) noexcept;

/// The same after Stiles and Holladay with the age of Vos 2003; 1 ... 30 degrees.
double stiles_holladay_veil(double theta, double age) noexcept;

}  // namespace scotopic

// The lenticular halo: the ring, red outside, around a lamp seen with a wide pupil. The lens's fibres stand
// like spokes and diffract light by some 3 degrees. Smooth here; in life it is of fine spokes that flicker.
#pragma once

#include <array>

namespace scotopic {

/// Standard deviation of the ring across, degrees.
inline constexpr double halo_sigma = 0.15911146;  // 1/sqrt(2 x 19.75): Spencer's exponent

/// Radius of the ring, degrees, at a wavelength in nm: 3 degrees at 568 (Simpson 1953).
double halo_radius(double wavelength) noexcept;

/// The ring of all the light of a point, 1/sr, `theta` degrees from it: a Gaussian across, whose integral
/// over the sphere is 1 to 1e-3 from 400 to 700 nm. Spencer, Shirley, Zimmerman and Greenberg,
/// "Physically-based glare effects for digital images", SIGGRAPH 1995, f3: 436.9 (568/nm) exp(-19.75 (theta -
/// 3 nm/568)^2).
double halo_psf(double theta, double wavelength) noexcept;

/// Share of a point's light in the ring, of an eye that sees it at strength 1: 0.033, as Spencer's scotopic
/// eye has it, for pupils from 7 mm on; less in proportion down to none at 3 mm, as only what lies outside
/// the middle 3 mm of the lens has fibres that lie across the light.
double halo_share(double pupil_mm) noexcept;

/// What stands for each plane of light, nm: R, G, B, then L, M, S and rods at their peaks.
inline constexpr std::array<double, 7> halo_wavelengths = {610, 550, 465, 570, 543, 442, 507};

}  // namespace scotopic

// How wide the pupil is at an adaptation luminance, and the retinal illuminance that follows.
#pragma once

namespace scotopic {

/// Pupil diameter in mm at `adaptation` cd/m2 (>= 0), by the unified formula of Watson & Yellott, "A unified
/// formula for light-adapted pupil size", J. Vision 12(10):12, 2012: a 60 degree field (2827.43 deg2), both
/// eyes (e = 1), age 28.58 (the formula's reference, so its age term is 0 there). To 2 ulp.
double pupil_diameter_mm(double adaptation) noexcept;

/// Trolands per cd/m2: the pupil's area in mm2, to 6 ulp. 20.91 at 1 cd/m2, 39.76 at .01, 6.59 at 100.
double trolands_per_luminance(double adaptation) noexcept;

}  // namespace scotopic

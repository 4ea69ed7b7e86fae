// Coloured lamps: how far an eye gets used to a lamp's colour. A sodium street stays orange at night.
#pragma once

#include "kernel/matrix3.h"

namespace scotopic {

/// The white that RGB spaces are brought to here: D65, Y = 1, from x = 0.3127, y = 0.3290.
inline constexpr Vec3<double> adapted_white = {0.3127 / 0.3290, 1.0, (1 - 0.3127 - 0.3290) / 0.3290};

/// What surrounds the picture's field: F of CIECAM02.
inline constexpr double average_surround = 1.0;
inline constexpr double dim_surround = 0.9;
inline constexpr double dark_surround = 0.8;

/// Degree of adaptation, D = F (1 - e^(-(La + 42)/92)/3.6), of CIECAM02 (CIE 159:2004) and CAT16; from
/// memory. La in cd/m2,
/// >= 0. In [0, 1]; 0.824 at 0.01 cd/m2, 0.941 at 100.
double adaptation_degree(double adaptation, double surround = average_surround) noexcept;

/// The matrix, on XYZ, by which a scene lit by `lamp` (XYZ, any scale, Y > 0) is seen by an eye that is
/// adapted to it to `degree` (0 to 1): von Kries in the sharpened cones of CAT16 (Li et al. 2017). The lamp's
/// white becomes `degree` D65's colour and 1 - `degree` its own, at the same Y. Exactly the identity where
/// degree is 0 or the lamp is D65.
Matrix3<double> adapt_to_lamp(const Vec3<double>& lamp, double degree) noexcept;

}  // namespace scotopic

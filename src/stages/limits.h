// Where the pixel stages end.
#pragma once

namespace scotopic {

/// From here on cones see alone (cd/m2): MES2 has m = 1 and the chroma factor is 1, so nothing is computed.
inline constexpr double photopic_limit = 5.0;

/// A pixel with a component of larger magnitude (or none: NaN) passes unchanged: float sums would overflow.
inline constexpr double operable_limit = 0x1p120;

}  // namespace scotopic

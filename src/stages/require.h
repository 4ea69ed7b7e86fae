// What filters demand of their parameters and windows.
#pragma once

#include <cmath>
#include <stdexcept>

namespace scotopic {

/// Throws std::invalid_argument, with this message, where it does not hold.
inline void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

inline bool positive(double x) { return std::isfinite(x) && x > 0; }

}  // namespace scotopic

#include "adaptation/chromatic_adaptation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace scotopic {
namespace {

// Li et al., "Comprehensive color solutions: CAM16, CAT16, and CAM16-UCS", Color Res. Appl. 42(6), 2017; from
// memory.
constexpr Matrix3<double> cat16{
    {{{0.401288, 0.650173, -0.051461}, {-0.250268, 1.204414, 0.045854}, {-0.002079, 0.048952, 0.953127}}}};

// A colour beyond the spectrum can have a response of 0 or less, to which nothing adapts.
constexpr double least_response = 1e-6;

}  // namespace

double adaptation_degree(double adaptation, double surround) noexcept {
  return std::clamp(surround * (1 - std::exp(-(adaptation + 42) / 92) / 3.6), 0.0, 1.0);
}

Matrix3<double> adapt_to_lamp(const Vec3<double>& lamp, double degree) noexcept {
  const Vec3<double> to = cat16 * adapted_white;
  const Vec3<double> from = cat16 * Vec3<double>{lamp[0] / lamp[1], 1, lamp[2] / lamp[1]};
  Vec3<double> gain{};
  for (std::size_t i = 0; i < 3; ++i) gain[i] = 1 + degree * (to[i] / std::max(from[i], least_response) - 1);
  if (gain == Vec3<double>{1, 1, 1}) return identity3<double>();
  return inverse(cat16) * (diagonal(gain) * cat16);
}

}  // namespace scotopic

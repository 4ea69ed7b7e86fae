#include "adaptation/mesopic.h"

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

constexpr double c = mes2_efficacy_ratio;

// Lmes / Lp as a function of m, for a light of the given S/P ratio.
double mesopic_over_photopic(double m, double sp_ratio) {
  return (m + (1 - m) * sp_ratio * c) / (m + (1 - m) * c);
}

}  // namespace

double mesopic_luminance(double photopic, double scotopic, double m) noexcept {
  return (m * photopic + (1 - m) * scotopic * c) / (m + (1 - m) * c);
}

MesopicState mesopic_state(double photopic, double scotopic) noexcept {
  double m = 0.5;
  double luminance = 0;
  for (int i = 0; i < 500; ++i) {
    luminance = mesopic_luminance(photopic, scotopic, m);
    // log10(0) = -inf is clamped like any other dark luminance.
    const double next = std::clamp(mes2_offset + mes2_slope * std::log10(luminance), 0.0, 1.0);
    if (std::abs(next - m) < 1e-16) break;
    m = next;
  }
  return {m, luminance};
}

double mesopic_photopic_limit() noexcept { return std::pow(10.0, (1 - mes2_offset) / mes2_slope); }

double mesopic_scotopic_limit(double sp_ratio) noexcept {
  return std::pow(10.0, -mes2_offset / mes2_slope) / sp_ratio;
}

double mesopic_coefficient(double photopic, double sp_ratio) noexcept {
  if (!(photopic > mesopic_scotopic_limit(sp_ratio))) return 0;
  if (photopic >= mesopic_photopic_limit()) return 1;
  // F(m) = .767 + .3334 (log10 Lp + log10(Lmes/Lp)(m)) - m = 0; F' is close to -1, so few steps suffice.
  const double from_photopic = mes2_offset + mes2_slope * std::log10(photopic);
  constexpr double slope = mes2_slope / 2.302585092994045684;  // per natural logarithm
  double m = std::clamp(from_photopic, 0.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const double f = from_photopic + mes2_slope * std::log10(mesopic_over_photopic(m, sp_ratio)) - m;
    const double df =
        slope * ((1 - sp_ratio * c) / (m + (1 - m) * sp_ratio * c) - (1 - c) / (m + (1 - m) * c)) - 1;
    const double step = f / df;
    m = std::clamp(m - step, 0.0, 1.0);
    if (std::abs(step) < 1e-16) break;
  }
  return m;
}

}  // namespace scotopic

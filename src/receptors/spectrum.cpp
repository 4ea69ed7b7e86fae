#include "receptors/spectrum.h"

#include <algorithm>
#include <cmath>

#include "receptors/tables.h"

namespace scotopic {

double integrate(const TabulatedCurve& spectrum, const TabulatedCurve& sensitivity) {
  const double first = std::ceil(std::max(spectrum.first_nm, sensitivity.first_nm));
  const double last = std::floor(std::min(spectrum.last_nm(), sensitivity.last_nm()));
  long double sum = 0.0L;
  for (double nm = first; nm <= last; nm += 1.0)
    sum += static_cast<long double>(spectrum.at(nm)) * static_cast<long double>(sensitivity.at(nm));
  return static_cast<double>(sum);
}

PhotopicLuminance photopic_luminance(const TabulatedCurve& radiance) {
  return {photopic_efficacy * integrate(radiance, tables::xyz_cie_1931_2deg_y)};
}

ScotopicLuminance scotopic_luminance(const TabulatedCurve& radiance) {
  return {scotopic_efficacy * integrate(radiance, tables::scotopic_cie_1951_v_prime)};
}

double sp_ratio(const TabulatedCurve& spectrum) {
  return scotopic_luminance(spectrum).cdm2 / photopic_luminance(spectrum).cdm2;
}

}  // namespace scotopic

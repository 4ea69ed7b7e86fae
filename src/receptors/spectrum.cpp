#include "receptors/spectrum.h"

#include <algorithm>
#include <cmath>

#include "receptors/tables.h"

namespace scotopic {
namespace {

double daylight_x(double kelvin) {
  const double t = 1e3 / kelvin;
  if (kelvin <= 7000.0) return ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063;
  return ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
}

}  // namespace

Spectrum cie_daylight(double kelvin) {
  const double x = daylight_x(kelvin);
  const double y = (-3.000 * x + 2.870) * x - 0.275;
  const double denominator = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / denominator;
  const double m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / denominator;
  const TabulatedCurve& mean = tables::daylight_components_cie_s0;
  Spectrum daylight{mean.first_nm, mean.step_nm, {}};
  for (std::size_t i = 0; i < mean.values.size(); ++i)
    daylight.values.push_back(mean.values[i] + m1 * tables::daylight_components_cie_s1.values[i] +
                              m2 * tables::daylight_components_cie_s2.values[i]);
  return daylight;
}

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

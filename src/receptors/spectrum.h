// Curves over wavelength, and the luminance of a spectrum.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scotopic {

/// Luminous efficacies of radiation, lm/W, at the peaks of V (CIE 1924) and V' (CIE 1951): ISO 23539.
inline constexpr double photopic_efficacy = 683.002;
inline constexpr double scotopic_efficacy = 1700.06;

/// cd/m2 as the light-adapted eye weighs light; not interchangeable with ScotopicLuminance.
struct PhotopicLuminance {
  double cdm2 = 0.0;
};

/// cd/m2 as the fully dark-adapted eye weighs light.
struct ScotopicLuminance {
  double cdm2 = 0.0;
};

/// Values at evenly spaced wavelengths. A view: the values live elsewhere, for a built-in table as long as
/// the program. `step_nm` > 0, at least one value.
struct TabulatedCurve {
  double first_nm = 0.0;
  double step_nm = 1.0;
  std::span<const double> values;

  /// Wavelength of the last value.
  constexpr double last_nm() const { return first_nm + step_nm * static_cast<double>(values.size() - 1); }

  /// Linear between samples, 0 outside [first_nm, last_nm].
  constexpr double at(double nm) const {
    const double position = (nm - first_nm) / step_nm;
    const double last = static_cast<double>(values.size() - 1);
    if (!(position >= 0.0 && position <= last)) return 0.0;
    const auto index = static_cast<std::size_t>(position);
    const double fraction = position - static_cast<double>(index);
    if (fraction == 0.0) return values[index];
    return values[index] + fraction * (values[index + 1] - values[index]);
  }
};

/// A curve that owns its values.
struct Spectrum {
  double first_nm = 0.0;
  double step_nm = 1.0;
  std::vector<double> values;

  /// A view of it, valid as long as this lives.
  TabulatedCurve curve() const { return {first_nm, step_nm, values}; }
};

/// Daylight of a correlated colour temperature of 4000 to 25000 K, relative to 100 at 560 nm: CIE
/// 015:2018, 4.1.2.
Spectrum cie_daylight(double kelvin);

/// Integral of spectrum times sensitivity over wavelength, nm: the sum over whole nanometres, as CIE 015
/// asks.
double integrate(const TabulatedCurve& spectrum, const TabulatedCurve& sensitivity);

/// Luminance of a spectral radiance in W/(m2 sr nm); of any other spectral quantity, the like.
PhotopicLuminance photopic_luminance(const TabulatedCurve& radiance);
/// The same with V'.
ScotopicLuminance scotopic_luminance(const TabulatedCurve& radiance);

/// Scotopic over photopic luminance; the spectrum's scale does not matter. NaN for a spectrum that is all
/// dark.
double sp_ratio(const TabulatedCurve& spectrum);

}  // namespace scotopic

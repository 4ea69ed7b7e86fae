// The closed forms of adaptation over a number type V: double, for the functions of pupil.h and thresholds.h,
// which say what they are, and shaders/ to write them down in other languages. V has + - * / and comparisons
// with itself and double; pow, log10, log2, min and chosen are found beside it, or here and in std for
// double.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adaptation/thresholds.h"

namespace scotopic::closed_forms {

/// a where `yes`, else b. Both are computed: one may be NaN.
inline double chosen(bool yes, double a, double b) { return yes ? a : b; }

/// pupil_diameter_mm().
template <class V>
V pupil_diameter_mm(const V& adaptation) {
  using std::pow;
  constexpr double field_deg2 = 2827.43;
  constexpr double reference_flux = 846;  // cd/m2 deg2
  const V t = pow(adaptation * field_deg2 / reference_flux, 0.41);
  // 7.75 - 5.75 t/(t+2) written so that t = inf gives 2 mm, not NaN.
  return 2.0 + 5.75 * 2.0 / (t + 2.0);
}

/// trolands_per_luminance().
template <class V>
V trolands_per_luminance(const V& adaptation) {
  const V d = pupil_diameter_mm(adaptation);
  return std::numbers::pi / 4 * d * d;
}

/// log10 of visible_difference().
template <class V>
V log_visible_difference(const V& luminance) {
  using std::log10;
  using std::pow;
  const V l = log10(luminance);
  const V photopic = chosen(l <= 1.9176, pow(0.249 * l + 0.65, 2.7) - 0.72, l - 1.255);
  const V mesopic = chosen(l <= -0.0184, l - 0.395, photopic);
  const V scotopic = chosen(l <= -1.2, pow(0.405 * l + 1.6, 2.18) - 2.86, mesopic);
  return chosen(l <= -3.9506, V(-2.86), scotopic);
}

/// visible_difference().
template <class V>
V visible_difference(const V& luminance) {
  using std::pow;
  return pow(V(10.0), log_visible_difference(luminance));
}

/// joint_sensitivity().
template <class V>
V joint_sensitivity(const V& luminance) {
  using std::pow;
  return pow(pow(4.0627 / luminance, 1.6596) + 1.0, -0.2712);
}

/// visibility_stops().
template <class V>
V visibility_stops(const V& adaptation, VisibilityRule rule, const V& viewing) {
  using std::log2;
  using std::min;
  if (rule == VisibilityRule::hdrvdp2)
    return min(V(0.0), log2(joint_sensitivity(adaptation) / joint_sensitivity(viewing)));
  const V visible = visible_difference(viewing) / visible_difference(adaptation);
  return min(V(0.0), log2(adaptation / viewing * visible));
}

}  // namespace scotopic::closed_forms

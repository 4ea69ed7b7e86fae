// OperatorConstants as the stages' formulas read them: products worked out in double, then rounded once.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>

#include "adaptation/mesopic.h"
#include "kernel/rod_input.h"
#include "receptors/receptor_space.h"
#include "stages/shared/constants.h"
#include "stages/shared/mesopic_fit.h"
#include "stages/shared/projection.h"

namespace scotopic {

/// Number types of the batch and what each needs for its own last digit.
template <typename T>
struct BatchPrecision;
/// Terms that leave an error under float's last digit.
template <>
struct BatchPrecision<float> {
  static constexpr std::size_t mesopic_degree = 7;
  static constexpr std::size_t log_terms = 5;
};
/// Terms that leave an error under double's last digit.
template <>
struct BatchPrecision<double> {
  static constexpr std::size_t mesopic_degree = 17;
  static constexpr std::size_t log_terms = 12;
};

/// Lloc, and the rods' share at it.
template <typename T>
struct WeightConstants {
  T unit, adaptation, scotopic_limit, photopic_limit;
  T behind;                    ///< L_r - La: rods that are still adapting
  T luminance_rounding;        ///< of y_row's sum, in cd/m2, per sum of its terms' magnitudes
  T inverse_high, per_octave;  ///< v = -log2(L * inverse_high) * per_octave
  std::array<T, BatchPrecision<T>::mesopic_degree + 1> mesopic;  ///< (1 - m)/v as a polynomial in v
  std::array<T, BatchPrecision<T>::log_terms>
      log_series;  ///< log2 f = s sum_k log_series[k] s^2k, s = (f-1)/(f+1)
};

/// Cones and rods from colour.
template <typename T>
struct ReceptorConstants {
  Vec3<T> y_row;  ///< luminance
  Matrix3<T> lms_from_rgb, xyz_from_rgb;
  Vec3<T> rod_row;  ///< rods, linear estimate
  T rod_floor;      ///< smallest rod signal, times Y
  T rod_sp;         ///< rod signal per unit of the quadratic estimate
  std::array<T, 6> rod_quadratic;
};

/// kappa of one pathway by level, max(0, min(held, max(knee + steep (level[0] - L), shallow (level[1] -
/// L)))): convex where it is not held, so the greater of its two lines (kernel/rod_input.h).
template <typename T>
struct RodInputLines {
  T held, knee, steep, shallow;
  T inverse_usual;  ///< 1 / kappa of kirk2011
};

/// Model::cao2008.
template <typename T>
struct RodInputConstants {
  T behind;                ///< as in the weight: rods count as in the light they are used to
  std::array<T, 2> level;  ///< cd/m2: where each line ends
  RodInputLines<T> lm, s;
};

/// The kernel, and the projection of what it moves.
template <typename T>
struct ShiftConstants {
  Vec3<T> kappa, gain;   ///< gain per image unit
  Matrix3<T> rgb_shift;  ///< Δrgb = rgb_shift (g r)
  Matrix3<T> lms_shift;  ///< Δq = lms_shift (g r)
  Matrix3<T> rgb_from_lms;
  T strength;
  Matrix3<T> gamut_from_rgb, rgb_from_gamut;
  std::array<typename GamutProjection<T>::ActiveSet, GamutProjection<T>::active_sets> active;
  RodInputConstants<T> input;
};

/// Luminance policy.
template <typename T>
struct LuminanceConstants {
  T rods_weight;  ///< rho C
  T inverse_rod_white;
  T left;  ///< 1 - strength
  T floor;
  Vec3<T> inverse_cone_white;
};

/// Chroma against luminance.
template <typename T>
struct ChromaConstants {
  T strength, at_5, half;
};

/// What is on.
struct StageSwitches {
  bool safko, local, mesopic_policy, quadratic_rods, shift, project, gamut_is_rgb, luminance, chroma, mix,
      adapting, rod_input;

  explicit StageSwitches(const OperatorConstants& c) noexcept
      : safko(c.parameters.model == Model::safko2019),
        local(c.parameters.weight == Weight::local),
        mesopic_policy(c.parameters.luminance == LuminancePolicy::mesopic),
        quadratic_rods(c.parameters.rods == RodEstimate::quadratic),
        shift(c.shift > 0),
        project(c.project),
        gamut_is_rgb(c.gamut_is_rgb),
        luminance(c.luminance > 0),
        chroma(c.chroma > 0),
        mix(c.mix > 0 && c.mix < 1),
        adapting(c.parameters.rod_adaptation.has_value()),
        rod_input(c.parameters.model == Model::cao2008) {}
};

/// Stages that code without branches is compiled for; all with local weight, linear rods, and a projection
/// into the gamut of the RGB that comes in where there is a shift. `any` asks the switches instead.
enum class StageSet {
  any,
  usual,  ///< any, but rod input is the preset's own: its code is the shorter for it
  all,    ///< shift, mesopic luminance, chroma: what a look has by default
  grey,   ///< shift, photopic luminance, chroma: what the planner leaves of it where S/P ratios are white's
  shift,  ///< one alone
  chroma,
  kernel  ///< safko2019
};

/// The set that is on; any, where there is no loop for just that.
constexpr StageSet stage_set(const StageSwitches& on) noexcept {
  if (on.adapting || on.rod_input || on.quadratic_rods || (on.mix && !on.safko)) return StageSet::any;
  if (on.safko) return StageSet::kernel;
  if (!on.local || (on.shift && !on.gamut_is_rgb)) return StageSet::any;
  if (on.shift && on.luminance && on.chroma) return on.mesopic_policy ? StageSet::all : StageSet::grey;
  if (on.shift && !on.luminance && !on.chroma) return StageSet::shift;
  if (!on.shift && !on.luminance && on.chroma) return StageSet::chroma;
  return StageSet::any;
}

/// All that formulas read, in the number type they work in: nothing but numbers of type T.
template <typename T>
struct StageConstants {
  WeightConstants<T> weight;
  ReceptorConstants<T> receptors;
  ShiftConstants<T> shift;
  LuminanceConstants<T> luminance;
  ChromaConstants<T> chroma;
  T mix;  ///< share of the result in what comes out

  /// Rounds each product once.
  explicit StageConstants(const OperatorConstants& c);
};

/// Each component to the nearest of the number type.
template <typename T>
Vec3<T> rounded(const Vec3<double>& v) {
  return {static_cast<T>(v[0]), static_cast<T>(v[1]), static_cast<T>(v[2])};
}

template <typename T>
WeightConstants<T> weight_constants(const AppearanceParameters& p) {
  const auto t = [](double x) { return static_cast<T>(x); };
  WeightConstants<T> k{};
  k.unit = t(p.white_luminance);
  k.luminance_rounding = t(0x1p-20 * p.white_luminance);  // 4 roundings in float, and room
  k.adaptation = t(p.adaptation);
  k.behind = t(p.rod_adaptation.value_or(p.adaptation) - p.adaptation);
  k.scotopic_limit = t(mesopic_scotopic_limit());
  k.photopic_limit = t(mesopic_photopic_limit());
  const MesopicFit<BatchPrecision<T>::mesopic_degree> fit;
  k.inverse_high = t(1 / fit.high);
  k.per_octave = t(-1 / fit.octaves);
  for (std::size_t i = 0; i < k.mesopic.size(); ++i) k.mesopic[i] = t(fit.coefficient[i]);
  // log2((1+s)/(1-s)) = 2/ln 2 (s + s^3/3 + s^5/5 + ...).
  for (std::size_t i = 0; i < k.log_series.size(); ++i)
    k.log_series[i] = t(2 / std::numbers::ln2 / static_cast<double>(2 * i + 1));
  return k;
}

template <typename T>
ReceptorConstants<T> receptor_constants(const OperatorConstants& c) {
  const AppearanceParameters& p = c.parameters;
  const double per_scotopic = rod_signal_per_scotopic_luminance();
  const double sp = p.sp_ratio / sp_ratio_d65 * per_scotopic;
  const Vec3<double> linear = transpose(p.xyz_from_rgb) * scotopic_linear_from_xyz;
  ReceptorConstants<T> k{rounded<T>(c.luminance_from_rgb),
                         c.lms_from_rgb.to<T>(),
                         p.xyz_from_rgb.to<T>(),
                         rounded<T>({sp * linear[0], sp * linear[1], sp * linear[2]}),
                         static_cast<T>(per_scotopic * sp_ratio_floor),
                         static_cast<T>(sp),
                         {}};
  for (std::size_t i = 0; i < 6; ++i) k.rod_quadratic[i] = static_cast<T>(scotopic_quadratic_from_xy[i]);
  return k;
}

template <typename T>
RodInputLines<T> rod_input_lines(const double (&level)[3], const double (&kappa)[3], double usual) {
  const auto t = [](double x) { return static_cast<T>(x); };
  const auto slope = [&](std::size_t i) { return t((kappa[i] - kappa[i + 1]) / (level[i + 1] - level[i])); };
  return {t(kappa[0]), t(kappa[1]), slope(0), slope(1), t(1 / usual)};
}

template <typename T>
RodInputConstants<T> rod_input_constants(const AppearanceParameters& p, const Vec3<double>& usual) {
  const auto& [level, of_lm, of_s] = cao2008_table;
  return {static_cast<T>(p.rod_adaptation.value_or(p.adaptation) - p.adaptation),
          {static_cast<T>(level[1]), static_cast<T>(level[2])},
          rod_input_lines<T>(level, of_lm, usual[0]),
          rod_input_lines<T>(level, of_s, usual[2])};
}

template <typename T>
ShiftConstants<T> shift_constants(const OperatorConstants& c) {
  const AppearanceParameters& p = c.parameters;
  const Matrix3<double> back = p.model == Model::safko2019 ? rgb_from_lms_cat02(p) : c.rgb_from_lms;
  ShiftConstants<T> k{};
  k.kappa = rounded<T>(c.kernel.kappa());
  for (std::size_t i = 0; i < 3; ++i) k.gain[i] = static_cast<T>(c.kernel.gain()[i] * p.white_luminance);
  k.lms_shift = c.kernel.cone_shift().to<T>();
  k.rgb_shift = (back * c.kernel.cone_shift()).to<T>();
  k.rgb_from_lms = back.to<T>();
  k.strength = static_cast<T>(c.shift);
  k.input = rod_input_constants<T>(p, c.kernel.kappa());
  k.gamut_from_rgb = c.gamut_from_rgb.to<T>();
  k.rgb_from_gamut = c.rgb_from_gamut.to<T>();
  if (!c.project) return k;
  const GamutProjection<T> projection(lms_from_xyz() * *p.xyz_from_gamut);
  for (std::size_t i = 0; i < k.active.size(); ++i) k.active[i] = projection.set(i);
  return k;
}

template <typename T>
LuminanceConstants<T> luminance_constants(const OperatorConstants& c) {
  const auto t = [](double x) { return static_cast<T>(x); };
  LuminanceConstants<T> k{
      t(sp_ratio_d65 * mes2_efficacy_ratio), t(1 / c.rod_white), t(1 - c.luminance), t(luminance_floor), {}};
  for (std::size_t i = 0; i < 3; ++i) k.inverse_cone_white[i] = t(1 / c.cone_white[i]);
  return k;
}

template <typename T>
ChromaConstants<T> chroma_constants(const OperatorConstants& c) {
  return {static_cast<T>(c.chroma), static_cast<T>((5 + chroma_half_luminance) / 5),
          static_cast<T>(chroma_half_luminance)};
}

template <typename T>
StageConstants<T>::StageConstants(const OperatorConstants& c)
    : weight(weight_constants<T>(c.parameters)),
      receptors(receptor_constants<T>(c)),
      shift(shift_constants<T>(c)),
      luminance(luminance_constants<T>(c)),
      chroma(chroma_constants<T>(c)),
      mix(static_cast<T>(c.mix)) {}

}  // namespace scotopic

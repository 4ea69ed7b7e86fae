// OperatorConstants as the vector code wants them: products worked out in double, then rounded once.
#pragma once

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

#include "adaptation/mesopic.h"
#include "stages/shared/constants.h"
#include "stages/shared/mesopic_fit.h"
#include "stages/shared/projection.h"
#include "receptors/receptor_space.h"

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

/// Stages that code without branches is compiled for; all with local weight, linear rods, and a projection into the
/// gamut of the RGB that comes in where there is a shift. `any` asks the constants instead.
enum class StageSet {
  any,
  all,        ///< shift, mesopic luminance, chroma: what a look has by default
  grey,       ///< shift, photopic luminance, chroma: what the planner leaves of it where S/P ratios are white's
  shift,      ///< one alone
  chroma,
  kernel      ///< safko2019
};

/// What the vector loops read, in the number type they work in.
template <typename T>
struct BatchConstants {
  static constexpr std::size_t mesopic_terms = BatchPrecision<T>::mesopic_degree + 1;
  static constexpr std::size_t log_terms = BatchPrecision<T>::log_terms;

  /// Rounds each product once.
  explicit BatchConstants(const OperatorConstants& c);

  /// The stages that are on; any, where there is no loop for just these.
  StageSet stages() const noexcept;

  // What is on.
  bool safko, local, mesopic_policy, quadratic_rods, do_shift, project, gamut_is_rgb, do_luminance, do_chroma;

  // Weight.
  T unit, adaptation, scotopic_limit, photopic_limit;
  T luminance_rounding;                       // of y_row's sum, in cd/m2, per sum of its terms' magnitudes
  T inverse_high, per_octave;                 // v = -log2(L * inverse_high) * per_octave
  std::array<T, mesopic_terms> mesopic;       // (1 - m)/v as a polynomial in v
  std::array<T, log_terms> log_series;        // log2 f = s sum_k log_series[k] s^2k, s = (f-1)/(f+1)

  // Receptors and kernel.
  Vec3<T> y_row;                              // luminance
  Matrix3<T> lms_from_rgb, rgb_from_lms, xyz_from_rgb;
  Vec3<T> rod_row;                            // rods, linear estimate
  T rod_floor;                                // smallest rod signal, times Y
  T rod_sp;                                   // rod signal per unit of the quadratic estimate
  std::array<T, 6> rod_quadratic;
  Vec3<T> kappa, gain;                        // gain per image unit
  Matrix3<T> rgb_shift;                       // Δrgb = rgb_shift (g r)
  Matrix3<T> lms_shift;                       // Δq = lms_shift (g r)
  T shift;

  // Projection.
  Matrix3<T> gamut_from_rgb, rgb_from_gamut;
  std::array<typename GamutProjection<T>::ActiveSet, GamutProjection<T>::active_sets> active;

  // Luminance and chroma.
  T rods_weight;                              // rho C
  T inverse_rod_white, luminance_left, luminance_goal, floor;  // luminance_left: 1 - its strength
  Vec3<T> inverse_cone_white;
  T chroma, chroma_at_5, chroma_half;
};

template <typename T>
StageSet BatchConstants<T>::stages() const noexcept {
  if (quadratic_rods) return StageSet::any;
  if (safko) return StageSet::kernel;
  if (!local || (do_shift && !gamut_is_rgb)) return StageSet::any;
  if (do_shift && do_luminance && do_chroma) return mesopic_policy ? StageSet::all : StageSet::grey;
  if (do_shift && !do_luminance && !do_chroma) return StageSet::shift;
  if (!do_shift && !do_luminance && do_chroma) return StageSet::chroma;
  return StageSet::any;
}

/// Each component to the nearest of the number type.
template <typename T>
Vec3<T> rounded(const Vec3<double>& v) {
  return {static_cast<T>(v[0]), static_cast<T>(v[1]), static_cast<T>(v[2])};
}

template <typename T>
BatchConstants<T>::BatchConstants(const OperatorConstants& c) {
  const AppearanceParameters& p = c.parameters;
  const auto t = [](double x) { return static_cast<T>(x); };
  safko = p.model == Model::safko2019;
  local = p.weight == Weight::local;
  mesopic_policy = p.luminance == LuminancePolicy::mesopic;
  quadratic_rods = p.rods == RodEstimate::quadratic;
  do_shift = c.shift > 0;
  project = c.project;
  gamut_is_rgb = c.gamut_is_rgb;
  do_luminance = c.luminance > 0;
  do_chroma = c.chroma > 0;

  unit = t(p.white_luminance);
  luminance_rounding = t(0x1p-20 * p.white_luminance);  // 4 roundings in float, and room
  adaptation = t(p.adaptation);
  scotopic_limit = t(mesopic_scotopic_limit());
  photopic_limit = t(mesopic_photopic_limit());
  const MesopicFit<BatchPrecision<T>::mesopic_degree> fit;
  inverse_high = t(1 / fit.high);
  per_octave = t(-1 / fit.octaves);
  for (std::size_t k = 0; k < mesopic_terms; ++k) mesopic[k] = t(fit.coefficient[k]);
  // log2((1+s)/(1-s)) = 2/ln 2 (s + s^3/3 + s^5/5 + ...).
  for (std::size_t k = 0; k < log_terms; ++k)
    log_series[k] = t(2 / std::numbers::ln2 / static_cast<double>(2 * k + 1));

  y_row = rounded<T>(c.luminance_from_rgb);
  lms_from_rgb = c.lms_from_rgb.to<T>();
  xyz_from_rgb = p.xyz_from_rgb.to<T>();
  const double per_scotopic = rod_signal_per_scotopic_luminance();
  const double sp = p.sp_ratio / sp_ratio_d65 * per_scotopic;
  const Vec3<double> linear = transpose(p.xyz_from_rgb) * scotopic_linear_from_xyz;
  rod_row = rounded<T>({sp * linear[0], sp * linear[1], sp * linear[2]});
  rod_floor = t(per_scotopic * sp_ratio_floor);
  rod_sp = t(sp);
  for (std::size_t k = 0; k < 6; ++k) rod_quadratic[k] = t(scotopic_quadratic_from_xy[k]);
  kappa = rounded<T>(c.kernel.kappa());
  for (std::size_t i = 0; i < 3; ++i) gain[i] = t(c.kernel.gain()[i] * p.white_luminance);
  lms_shift = c.kernel.cone_shift().to<T>();
  const Matrix3<double> back = safko ? rgb_from_lms_cat02(p) : c.rgb_from_lms;
  rgb_shift = (back * c.kernel.cone_shift()).to<T>();
  shift = t(c.shift);
  rgb_from_lms = back.to<T>();

  gamut_from_rgb = c.gamut_from_rgb.to<T>();
  rgb_from_gamut = c.rgb_from_gamut.to<T>();
  if (project) {
    const GamutProjection<T> projection(lms_from_xyz() * *p.xyz_from_gamut);
    for (std::size_t i = 0; i < active.size(); ++i) active[i] = projection.set(i);
  }

  rods_weight = t(sp_ratio_d65 * mes2_efficacy_ratio);
  inverse_rod_white = t(1 / c.rod_white);
  luminance_left = t(1 - c.luminance);
  luminance_goal = t(c.luminance_goal);
  floor = t(luminance_floor);
  for (std::size_t i = 0; i < 3; ++i) inverse_cone_white[i] = t(1 / c.cone_white[i]);
  chroma = t(c.chroma);
  chroma_at_5 = t((5 + chroma_half_luminance) / 5);
  chroma_half = t(chroma_half_luminance);
}

/// BatchConstants with each number as often as the widest vector has room for: a constant is then an operand in memory,
/// and takes no instruction of its own. (Too many for registers, they would be spread again for each use.)
template <typename T>
class WideConstants {
 public:
  static constexpr std::size_t lanes = 64 / sizeof(T);

  /// Spreads each number.
  explicit WideConstants(const OperatorConstants& c)
      : numbers(c), wide_(hwy::AllocateAligned<T>(count * lanes)) {
    if (!wide_) throw std::bad_alloc();
    for (std::size_t i = 0; i < count; ++i) {
      T number{};
      std::memcpy(&number, reinterpret_cast<const std::byte*>(&numbers) + i * sizeof(T), sizeof number);
      std::fill_n(wide_.get() + i * lanes, lanes, number);
    }
  }
  WideConstants(WideConstants&&) = delete;  // of() takes addresses

  const BatchConstants<T> numbers;

  /// `number`, one of those in `numbers`, in every lane; aligned to 64 bytes.
  const T* of(const T& number) const noexcept {
    const auto offset = reinterpret_cast<std::uintptr_t>(&number) - reinterpret_cast<std::uintptr_t>(&numbers);
    return wide_.get() + offset / sizeof(T) * lanes;
  }

 private:
  static constexpr std::size_t count = sizeof(BatchConstants<T>) / sizeof(T);
  hwy::AlignedFreeUniquePtr<T[]> wide_;
};

}  // namespace scotopic

// The appearance operator a second time, written from the formulas of docs/model.md and the papers it names,
// with an algebra of its own: in 256 bits to judge double, and in long double where millions of pixels are
// judged. Shared with the product: the types a pixel and a setting come in, and the measured curves, which
// tests/receptors/tables_test.cpp holds to their publications.
#pragma once

#include <array>

#include "stages/reference.h"
#include "properties/exact_algebra.h"
#include "properties/mpfr_number.h"

namespace scotopic::test {

/// Watson & Yellott 2012: pupil diameter, mm, at La cd/m2; 2827.43 deg2, both eyes, age 28.58.
template <typename Real>
Real exact_pupil_diameter(const Real& adaptation);

/// CIE 191:2010 MES2: the fixed point m at a photopic luminance (cd/m2) and S/P ratio; 0 at luminance 0.
template <typename Real>
Real exact_mesopic_coefficient(const Real& photopic, const Real& sp_ratio);

/// s(L)/s(5), at most 1, with s(L) = L/(L + .108) (Wanat & Mantiuk 2014).
template <typename Real>
Real exact_chroma_factor(const Real& luminance);

/// Everything of a setting that no pixel changes, in Real.
template <typename Real>
struct ExactSetting {
  explicit ExactSetting(const AppearanceParameters& parameters);

  AppearanceParameters parameters;
  Real units_per_watt;  // k
  Square<Real> lms_from_rgb, rgb_from_lms, gamut_from_rgb, rgb_from_gamut, lms_from_gamut, rgb_from_lms_safko;
  Square<Real> xyz_from_rgb;
  Square<Real> cone_shift;  // A^-1 N
  Triple<Real> kappa, gain;
  Triple<Real> cone_white;  // q of image white
  Real scale;               // T
  Real rod_white;
};

/// A result, and beside each component the sum of |terms| of the linear combinations it is made of, stage
/// after stage: what its own rounding errors are measured by.
template <typename Real>
struct Summed {
  Triple<Real> value, terms;
};

/// What the operator gives in exact arithmetic, to 2^-240 (Mp) or 2^-60 (long double) of the pixel's size.
/// A pixel with a component that is not finite or beyond 2^120 comes back as it is.
template <typename Real>
class ExactOperator {
 public:
  explicit ExactOperator(const AppearanceParameters& parameters) : s_(parameters) {}

  Triple<Real> operator()(const ReferencePixel& pixel) const { return with_terms(pixel).value; }
  Summed<Real> with_terms(const ReferencePixel& pixel) const;

  /// Δq in luminance units, for q, r in luminance units of 1 cd/m2.
  Triple<Real> shift(const Triple<Real>& q, const Real& r) const;

  /// The nearest colour, in LMS, with gamut components not below `bound` (which is <= 0).
  Triple<Real> nearest(const Triple<Real>& gamut_rgb, const Triple<Real>& bound) const;

  const ExactSetting<Real>& setting() const { return s_; }

 private:
  Real policy_luminance(const Real& y, const Real& rod, const Real& m) const;
  Real rod_signal(const Triple<Real>& rgb) const;
  Triple<Real> damped_rods(const Triple<Real>& q, const Real& r, const Triple<Real>& kappa) const;  // g R/T
  Triple<Real> rods_at(const Triple<Real>& q, const Real& r,
                       const Real& local) const;  // the same, as the model has it
  Summed<Real> safko(const Summed<Real>& q, const Real& r) const;

  ExactSetting<Real> s_;
};

extern template class ExactOperator<Mp>;
extern template class ExactOperator<long double>;
extern template struct ExactSetting<Mp>;
extern template struct ExactSetting<long double>;

}  // namespace scotopic::test

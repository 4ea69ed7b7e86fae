// Every function of one variable of the operator, at every float: the bound of each, in ulp.
#include "properties/one_variable.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>

#include "stages/acuity/cutoff.h"
#include "stages/acuity/simd-inl.h"
#include "adaptation/mesopic.h"
#include "adaptation/pupil.h"
#include "batch/batch.h"
#include "stages/shared/colour_difference.h"
#include "stages/shared/constants.h"
#include "properties/mpfr_reference.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

// Lane 0 of the acuity filter's float functions.
float lab_f_float(float t) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 4> d;
  return hn::GetLane(acuity::HWY_NAMESPACE::lab_f(d, hn::Set(d, t)));
}
float lab_f_inverse_float(float f) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 4> d;
  return hn::GetLane(acuity::HWY_NAMESPACE::lab_f_inverse(d, hn::Set(d, f)));
}

// The formulas, once for long double and once for 256 bits. A decimal constant is read once.
using std::abs, std::atan, std::cbrt, std::log10, std::sqrt;

template <typename Real>
Real exact_lab_f(const Real& t) {
  static const Real edge = Real(216) / Real(24389), slope = Real(841) / Real(108),
                    offset = Real(4) / Real(29);
  return t > edge ? cbrt(t) : t * slope + offset;
}
template <typename Real>
Real exact_lab_f_inverse(const Real& f) {
  static const Real edge = Real(6) / Real(29), slope = Real(108) / Real(841), offset = Real(4) / Real(29);
  return f > edge ? f * f * f : (f - offset) * slope;
}
template <typename Real>
Real exact_lightness(const Real& t) {
  static const Real at_black = Real(16) / Real(116);
  return exact_lab_f(t) - at_black;
}

// The operator in float on a light that rods do not see, eye dark: what MES2 leaves of its luminance, 1
// at 4.998 cd/m2, 0 at .00203. By the batch's own logarithm and polynomial.
float mesopic_share_of_batch(float luminance, Precision precision) {
  static const AppearanceParameters parameters = [] {
    AppearanceParameters p;
    p.adaptation = 1e-30;
    p.white_luminance = 1;
    p.xyz_from_rgb = rec709;
    p.strength.shift = p.strength.chroma = 0;
    return p;
  }();
  static const AppearanceBatch single(parameters), dual(parameters, Precision::dual);
  float r = luminance, g = luminance, b = luminance;
  const float rod = 0;
  PixelRows rows;
  rows.r = &r, rows.g = &g, rows.b = &b, rows.rod = &rod, rows.count = 1;
  (precision == Precision::single ? single : dual).apply(rows);
  return g / luminance;
}

template <typename Real>
Real exact_mesopic(const Real& luminance) {
  static const Real sp = decimal<Real>("2.4648");
  return exact_mesopic_coefficient(luminance, sp);
}
template <typename Real>
Real exact_share(const Real& luminance) {
  static const Real rods_per_share = decimal<Real>("2.4648") * Real(683) / Real(1699);
  const Real m = exact_mesopic(luminance);
  return m / (m + (Real(1) - m) * rods_per_share);
}
// Of a share that ends in 0: spacing of floats at 1.
Extended ulp_of_float_at_1(Extended) { return 0x1p-23L; }

template <typename Real>
Real exact_gain(const Real& q) {
  static const Real gain = decimal<Real>("0.33"), zero(0), one(1);
  return one / sqrt(Real(one + std::max(zero, Real(gain * q))));
}
template <typename Real>
Real exact_trolands(const Real& la) {
  static const Real quarter_pi = atan(Real(1));
  const Real d = exact_pupil_diameter(la);
  return quarter_pi * d * d;
}
template <typename Real>
Real exact_cutoff(const Real& l) {
  static const Real least = decimal<Real>("1e-5"), scale = decimal<Real>("17.25"),
                    slope = decimal<Real>("1.4"), shift = decimal<Real>("0.35"),
                    offset = decimal<Real>("25.72");
  return scale * atan(Real(slope * log10(Real(std::max(l, least))) + shift)) + offset;
}

constexpr float huge = std::numeric_limits<float>::max();
const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
const Kernel<float> kernel_float(kernel_preset(Model::kirk2011), 1.0);

const Function functions[] = {
    {"gain_double", -huge, huge, 3,
     [](float q) {
       return kernel.gains({static_cast<double>(q), 0, 0}, 0)[0];
     },
     exact_gain<Extended>, exact_gain<Mp>, ulp_of_double},
    {"gain_float", -huge, 1e38f, 3,
     [](float q) -> double {
       return kernel_float.gains({q, 0, 0}, 0)[0];
     },
     exact_gain<Extended>, exact_gain<Mp>, ulp_of_float},
    {"mesopic_coefficient", 0, huge, 2, [](float l) { return mesopic_coefficient(static_cast<double>(l)); },
     exact_mesopic<Extended>, exact_mesopic<Mp>, ulp_at_1},
    {"mesopic_share_float", 1e-20f, 4.9999f, 4,
     [](float l) -> double { return mesopic_share_of_batch(l, Precision::single); }, exact_share<Extended>,
     exact_share<Mp>, ulp_of_float_at_1},
    {"mesopic_share_dual", 1e-20f, 4.9999f, 1.5,
     [](float l) -> double { return mesopic_share_of_batch(l, Precision::dual); }, exact_share<Extended>,
     exact_share<Mp>, ulp_of_float_at_1},
    {"pupil_diameter", 0, huge, 2, [](float l) { return pupil_diameter_mm(static_cast<double>(l)); },
     exact_pupil_diameter<Extended>, exact_pupil_diameter<Mp>, ulp_of_double},
    {"trolands", 0, huge, 6, [](float l) { return trolands_per_luminance(static_cast<double>(l)); },
     exact_trolands<Extended>, exact_trolands<Mp>, ulp_of_double},
    {"chroma_factor_double", 0, huge, 4, [](float l) { return chroma_factor(static_cast<double>(l)); },
     exact_chroma_factor<Extended>, exact_chroma_factor<Mp>, ulp_of_double},
    {"chroma_factor_float", 0, 1e38f, 4, [](float l) -> double { return chroma_factor(l); },
     exact_chroma_factor<Extended>, exact_chroma_factor<Mp>, ulp_of_float},
    {"acuity_cutoff", 0, huge, 32, [](float l) { return acuity_cutoff(static_cast<double>(l)); },
     exact_cutoff<Extended>, exact_cutoff<Mp>, ulp_at_1},
    {"lab_lightness", -1e30f, 1e30f, 5,
     [](float t) {
       return lab_from_xyz({0, static_cast<double>(t), 0}).lightness / 116;
     },
     exact_lightness<Extended>, exact_lightness<Mp>, ulp_at_1},
    {"acuity_lab_f_float", 1e-3f, 1e10f, 9, [](float t) -> double { return lab_f_float(t); },
     exact_lab_f<Extended>, exact_lab_f<Mp>, ulp_of_float},
    {"acuity_lab_f_inverse_float", 0.21f, 2e3f, 2, [](float f) -> double { return lab_f_inverse_float(f); },
     exact_lab_f_inverse<Extended>, exact_lab_f_inverse<Mp>, ulp_of_float},
};

TEST_P(OneVariable, every_float_is_within_its_function_s_bound) { expect_within_bound(GetParam()); }

TEST_P(OneVariable, its_judge_agrees_with_256_bits_to_a_hundredth_of_an_ulp) {
  expect_sound_judge(GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, OneVariable, testing::ValuesIn(functions),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace scotopic::test

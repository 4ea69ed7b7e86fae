// The two published pipelines, as their formulas stand, line by line in 256 bits (77 digits): no matrix
// worked out beforehand, no kernel of the product's. What the program computes must be that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "properties/mpfr_reference.h"
#include "properties/regimes.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

using Mp3 = Vec3<Mp>;

Mp d(const char* text) { return decimal<Mp>(text); }
Mp at_least_0(const Mp& x) { return x > Mp(0) ? x : Mp(0); }

/// Safko's chapter on the model, and Kirk & O'Brien's section 3: LMSR in units of 1 cd/m2, T kernel units
/// each; returns L, M, S after the rods' intrusion, in the same units.
Mp3 cones_with_rods(const Mp3& q, const Mp& r, const Mp& t) {
  const Mp one(1), k1 = d("0.25"), k2 = d("0.40"), x = d("15"), y = d("15"), z = d("5");
  const Mp rho1 = d("1.111"), rho2 = d("0.939"), rho3 = d("0.400"), rho4 = d("0.150"), alpha = d("0.619");
  const Mp l_max = d("0.637"), m_max = d("0.392"), s_max = d("1.606");
  const Mp rods = t * at_least_0(r);
  const auto gain = [&](const Mp& cone, const Mp& kappa) {
    return one / sqrt(Mp(one + at_least_0(Mp(d("0.33") * (t * cone + kappa * rods)))));
  };
  const Mp gl = gain(q[0], k1), gm = gain(q[1], k1), gs = gain(q[2], k2);
  const Mp yellow = alpha * gl / l_max + (one - alpha) * gm / m_max;
  const Mp rg = x * k1 * (rho1 * gm / m_max - rho2 * gl / l_max) * rods;
  const Mp by = y * (rho3 * gs / s_max - rho4 * yellow) * rods;
  const Mp lum = z * yellow * rods;
  // o = A (L, M, S): rg = M - L, by = S - (L + M), lum = L + M.
  return {q[0] + (lum - rg) / Mp(2) / t, q[1] + (lum + rg) / Mp(2) / t, q[2] + (by + lum) / t};
}

/// The thesis' way back: peak-1 cone signals taken for CAT02's, in watts, times 683.002 lm/W. Solved by
/// Cramer's rule.
Mp3 xyz_by_cat02(const Mp3& cones, const Mp& units_per_watt) {
  const Mp a[3][3] = {{d("0.7328"), d("0.4296"), d("-0.1624")},
                      {d("-0.7036"), d("1.6975"), d("0.0061")},
                      {d("0.0030"), d("0.0136"), d("0.9834")}};
  const auto det = [](const Mp(&m)[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  Mp3 out;
  for (std::size_t column = 0; column < 3; ++column) {
    Mp b[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) b[i][j] = j == column ? cones[i] : a[i][j];
    out[column] = det(b) / det(a) * d("683.002") / units_per_watt;
  }
  return out;
}

/// Working RGB is XYZ itself, image value 1 is 1 cd/m2, and nothing but the kernel is on.
AppearanceParameters bare(Model model) {
  AppearanceParameters p;
  p.model = model;
  p.white_luminance = 1;
  p.luminance = LuminancePolicy::none;
  p.strength.chroma = 0;
  p.xyz_from_rgb = identity3<double>();
  return p;
}

struct Lmsr {
  Vec3<double> q;
  double r;
};

/// From starlight to noon; a tenth with a negative cone signal, a tenth without rods.
Lmsr draw(Random& random) {
  Lmsr s{};
  const double size = random.log_uniform(1e-6, 1e4);
  for (auto& x : s.q) x = size * random.log_uniform(1e-2, 1.0);
  s.r = size * random.log_uniform(1e-2, 1.0);
  if (random.chance(0.1)) s.q[2] = -s.q[2];
  if (random.chance(0.1)) s.r = 0;
  return s;
}

Mp3 wide(const Vec3<double>& v) { return {Mp(v[0]), Mp(v[1]), Mp(v[2])}; }

/// Greatest error of a component, of the exact result's largest.
double error_of(const Vec3<double>& got, const Mp3& exact) {
  double worst = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    worst = std::max(worst, std::abs(static_cast<double>(Mp(got[i]) - exact[i])));
    size = std::max(size, std::abs(static_cast<double>(exact[i])));
  }
  return worst / size;
}

constexpr int draws = 10000;

TEST(Literature, safko2019_is_the_thesis_formulas_in_77_digits) {
  AppearanceParameters p = bare(Model::safko2019);
  const Mp k = ExactSetting<Mp>(p).units_per_watt;
  Random random(2019);
  double worst = 0;
  int count = 0;
  for (const double t : {1.0, 20.0, 1e-3, 4000.0}) {
    p.safko_scale = t;
    const AppearanceReference safko(p);
    for (int i = 0; i < (t == 1 ? draws : draws / 5); ++i, ++count) {
      const Lmsr s = draw(random);
      const Mp3 exact = xyz_by_cat02(cones_with_rods(wide(s.q), Mp(s.r), Mp(t)), k);
      worst = std::max(worst, error_of(safko({{1, 1, 1}, s.q, s.r}), exact));
    }
  }
  std::printf("safko2019: worst %.3g of the largest component, %d LMSR\n", worst, count);
  EXPECT_LE(worst, 1e-12);
}

TEST(Literature, safko2019_takes_the_unit_out_and_puts_it_back) {
  AppearanceParameters p = bare(Model::safko2019);
  const Mp k = ExactSetting<Mp>(p).units_per_watt;
  p.white_luminance = 3.5;
  p.safko_scale = 12.25;
  const Vec3<double> q = {0.5, 0.4, 0.2};
  const Mp3 seen = cones_with_rods({Mp(3.5) * Mp(0.5), Mp(3.5) * Mp(0.4), Mp(3.5) * Mp(0.2)},
                                   Mp(3.5) * Mp(0.45), Mp(12.25));
  Mp3 exact = xyz_by_cat02(seen, k);
  for (auto& x : exact) x = x / Mp(3.5);
  EXPECT_LE(error_of(AppearanceReference(p)({{1, 1, 1}, q, 0.45}), exact), 1e-14);
}

TEST(Literature, kirk2011_with_all_else_off_is_safko2019_up_to_the_matrix) {
  // At .001 cd/m2 MES2 has m = 0, so that w = 1; the troland of that pupil is the thesis' T.
  AppearanceParameters p = bare(Model::kirk2011);
  p.adaptation = 0.001;
  p.weight = Weight::global;
  const ExactSetting<Mp> exact_setting(p);
  const AppearanceReference kirk(p);
  AppearanceParameters s = bare(Model::safko2019);
  s.safko_scale = kirk.constants().kernel_scale;
  const AppearanceReference safko(s);
  const Matrix3<double> thesis = rgb_from_lms_cat02(s), ours = kirk.constants().rgb_from_lms;
  const Matrix3<double> between = ours * inverse(thesis);
  Random random(2011);
  double worst = 0, worst_of_two = 0;
  for (int i = 0; i < draws; ++i) {
    const Lmsr x = draw(random);
    const Vec3<double> xyz = ours * x.q;  // the colour of these cones: delta form adds to it
    const Vec3<double> got = kirk({xyz, x.q, x.r});
    const Mp3 cones = cones_with_rods(wide(x.q), Mp(x.r), exact_setting.scale);
    worst = std::max(worst, error_of(got, exact_setting.rgb_from_lms * cones));
    const Vec3<double> carried = between * safko({xyz, x.q, x.r});
    worst_of_two = std::max(worst_of_two, error_of(carried, wide(got)));
  }
  std::printf(
      "kirk2011 alone: worst %.3g against 77 digits, %.3g against safko2019 times one matrix; %d LMSR\n",
      worst, worst_of_two, draws);
  EXPECT_LE(worst, 1e-12);
  EXPECT_LE(worst_of_two, 1e-12);
}

struct Grey {
  double x, y, luminance;  ///< chromaticity; Y over that of the grey
  Vec3<double> gain;       ///< linear Rec.709 over that of the grey
};

/// What becomes of a D65 grey of `luminance` cd/m2.
Grey seen(AppearanceParameters p, double luminance) {
  p.xyz_from_rgb = rec709;
  p.white_luminance = luminance;
  const Vec3<double> rgb = AppearanceReference(p)({{1, 1, 1}, {}, {}}), xyz = rec709 * rgb;
  const double sum = xyz[0] + xyz[1] + xyz[2];
  const Grey out = {xyz[0] / sum, xyz[1] / sum, xyz[1], rgb};
  std::printf("%g cd/m2: xy (%.4f, %.4f), Y x %.3f, RGB x (%.2f, %.2f, %.2f)\n", luminance, out.x, out.y,
              out.luminance, rgb[0], rgb[1], rgb[2]);
  return out;
}

TEST(Literature, the_thesis_way_back_tints_a_grey_that_no_rod_sees) {
  // Much light, or T without bound: the gains g go to 0, and what is left is the inverse of CAT02 on another
  // space's cone signals. docs/model.md tells these numbers.
  AppearanceParameters p = bare(Model::safko2019);
  p.safko_scale = 1e12;
  const Grey grey = seen(p, 1);
  EXPECT_NEAR(grey.x, 0.3988, 1e-4);
  EXPECT_NEAR(grey.y, 0.3743, 1e-4);
  EXPECT_NEAR(grey.luminance, 0.957, 1e-3);
  EXPECT_NEAR(grey.gain[0], 1.54, 0.01);
  EXPECT_NEAR(grey.gain[1], 0.83, 0.01);
  EXPECT_NEAR(grey.gain[2], 0.47, 0.01);
}

TEST(Literature, the_thesis_takes_a_grey_out_of_every_gamut_and_never_ends) {
  AppearanceParameters p = bare(Model::safko2019);  // T = 1
  const Grey dim = seen(p, 1), day = seen(p, 500);
  EXPECT_NEAR(dim.gain[0], -3.77, 0.01);
  EXPECT_NEAR(dim.gain[1], 8.19, 0.01);
  EXPECT_NEAR(dim.gain[2], 8.41, 0.01);
  EXPECT_NEAR(dim.luminance, 5.664, 2e-3);
  EXPECT_NEAR(day.luminance, 1.468, 2e-3);
  EXPECT_NEAR(day.x, 0.2869, 1e-4);
}

TEST(Literature, delta_form_leaves_a_grey_of_500_alone_and_a_dim_one_its_luminance) {
  for (const Model model : {Model::kirk2011, Model::filament2021}) {
    AppearanceParameters p;
    p.model = model;
    p.xyz_from_gamut = rec709;
    p.adaptation = 500;
    EXPECT_EQ(seen(p, 500).gain, (Vec3<double>{1, 1, 1}));
    p.adaptation = 1;
    const Grey dim = seen(p, 1);
    EXPECT_NEAR(dim.luminance, 1, 1e-12);
    for (const double gain : dim.gain) EXPECT_GE(gain, 0);
  }
}

}  // namespace
}  // namespace scotopic::test

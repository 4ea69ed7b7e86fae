// cao2008: rod input that follows the local luminance, against the operator written a second time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "adaptation/mesopic.h"
#include "kernel/rod_input.h"
#include "properties/judge.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

AppearanceParameters cao2008(double adaptation) {
  AppearanceParameters p;
  p.model = Model::cao2008;
  p.adaptation = adaptation;
  p.white_luminance = adaptation / 0.18;
  p.xyz_from_rgb = rec709;
  return p;
}

/// What rods add to (L, M, S), as the formulas stand: q, r and the result in cd/m2; `t` trolands per cd/m2.
Vec3<long double> added(const Vec3<double>& q, long double r, long double t, const Vec3<long double>& kappa) {
  const long double l = 0.637L, m = 0.392L, s = 1.606L, rods = t * r;
  const auto response = [&](std::size_t i, long double usual) {
    return kappa[i] / usual * rods / std::sqrt(1 + 0.33L * (t * q[i] + kappa[i] * rods));
  };
  const long double gl = response(0, 0.25L), gm = response(1, 0.25L), gs = response(2, 0.4L);
  const long double yellow = 0.619L * gl / l + 0.381L * gm / m;
  const long double rg = 15 * 0.25L * (1.111L * gm / m - 0.939L * gl / l);
  const long double by = 15 * (0.4L * gs / s - 0.15L * yellow), lum = 5 * yellow;
  return {(lum - rg) / 2 / t, (lum + rg) / 2 / t, (by + lum) / t};
}

TEST(RodInputByLevel, is_the_formula_with_kappa_of_the_local_luminance) {
  // kappa read off the published table by hand: at its levels, between them, below and beyond.
  const struct {
    double local;
    long double lm, s;
  } rows[] = {{0.05, 0.172619L, 0.714286L},
              {0.1027, 0.172619L, 0.714286L},
              {0.36275, (0.172619L + 0.0172619L) / 2, (0.714286L + 0.0202381L) / 2},
              {0.6228, 0.0172619L, 0.0202381L},
              {2.978575, 0.75L * 0.0172619L, 0.75L * 0.0202381L}};
  for (const auto& row : rows) {
    AppearanceParameters p = cao2008(row.local);
    p.weight = Weight::global;
    p.luminance = LuminancePolicy::none;
    p.strength.chroma = 0;
    const AppearanceReference op(p);
    const OperatorConstants& c = op.constants();
    const double unit = p.white_luminance;
    const Vec3<double> rgb = {0.2, 0.15, 0.3}, q = c.lms_from_rgb * rgb;
    const double r = rod_signal_from_rgb(c, rgb), w = 1 - mesopic_coefficient(row.local);
    const Vec3<long double> more =
        added({unit * q[0], unit * q[1], unit * q[2]}, unit * r, c.kernel_scale, {row.lm, row.lm, row.s});
    const Vec3<double> out = op({rgb});
    for (std::size_t i = 0; i < 3; ++i) {
      long double exact = rgb[i];
      for (std::size_t j = 0; j < 3; ++j) exact += c.rgb_from_lms[i][j] * w * more[j] / unit;
      EXPECT_NEAR(out[i], static_cast<double>(exact), 1e-12 * (1 + std::abs(out[i])))
          << row.local << " " << i;
    }
  }
}

TEST(RodInputByLevel, of_rods_that_still_adapt_is_that_of_the_light_they_are_used_to) {
  AppearanceParameters p = cao2008(0.01), bright = p;
  p.rod_adaptation = 0.5;  // after other light
  bright.adaptation = 0.5;
  for (AppearanceParameters* x : {&p, &bright}) {
    x->weight = Weight::global;
    x->luminance = LuminancePolicy::none;
    x->strength.chroma = 0;
    x->white_luminance = 1;
  }
  // The pupil is that of La: with the same trolands, kappa and weight are those of 0.5 cd/m2.
  const OperatorConstants c(p);
  const Vec3<double> rgb = {0.2, 0.15, 0.3}, q = c.lms_from_rgb * rgb, kappa = cao2008_kappa(0.5);
  const double w = 1 - mesopic_coefficient(0.5);
  const Vec3<long double> more =
      added(q, rod_signal_from_rgb(c, rgb), c.kernel_scale, {kappa[0], kappa[1], kappa[2]});
  const Vec3<double> out = AppearanceReference(p)({rgb});
  for (std::size_t i = 0; i < 3; ++i) {
    long double exact = rgb[i];
    for (std::size_t j = 0; j < 3; ++j) exact += c.rgb_from_lms[i][j] * w * more[j];
    EXPECT_NEAR(out[i], static_cast<double>(exact), 1e-12) << i;
  }
}

TEST(RodInputByLevel, every_way_of_computing_agrees_with_exact_arithmetic_in_every_regime) {
  Random random(2008);
  double worst[3] = {}, share[3] = {};
  constexpr const char* names[] = {"reference", "float", "double"};
  for (int setting = 0; setting < 300; ++setting) {
    AppearanceParameters p = draw_parameters(random);
    p.model = Model::cao2008;
    const Planes planes = draw_planes(random);
    const Evaluators way(p);
    const ExactOperator<long double> exact(p);
    std::vector<Sample> samples;
    for (int regime = 0; regime < regime_count; ++regime)
      for (int k = 0; k < 5; ++k)
        samples.push_back(draw(static_cast<Regime>(regime), way.reference.constants(), random));
    Rows single(samples), dual(samples);
    way.single.apply(single.view(planes));
    way.dual.apply(dual.view(planes));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const ReferencePixel pixel = samples[i].widened(planes);
      const auto expected = exact(pixel);
      const Strain strained = strain(way.reference.constants(), samples[i], planes);
      const auto s = single.rgb(i), d = dual.rgb(i);
      const Vec3<double> got[3] = {way.reference(pixel), {s[0], s[1], s[2]}, {d[0], d[1], d[2]}};
      for (const Way w : {Way::reference, Way::single, Way::dual}) {
        const std::size_t k = w == Way::reference ? 0 : w == Way::single ? 1 : 2;
        const double error = relative_error(got[k], expected, samples[i], planes, w);
        const double allowed = allowed_error(w, p.rods, strained);
        if (!strained.cancelled) worst[k] = std::max(worst[k], error);
        share[k] = std::max(share[k], error / allowed);
        ASSERT_LE(error, allowed) << names[k] << " " << to_text(p) << " " << samples[i].rgb[0] << " "
                                  << samples[i].rgb[1] << " " << samples[i].rgb[2];
      }
    }
  }
  for (int k = 0; k < 3; ++k)
    std::printf("cao2008, %s: worst %.3g of light, %.2f of what is allowed\n", names[k], worst[k], share[k]);
}

TEST(RodInputByLevel, a_jump_at_5_candelas_is_what_the_weight_prevents) {
  // At 5 cd/m2, where the pixel stages end, the data still have 4 % of the red-green input. Without 1 - m a
  // grey would change there by as much as this, at once.
  const Vec3<double> kappa = cao2008_kappa(5);
  EXPECT_NEAR(kappa[0] / 0.25, 0.036973, 1e-6);
  EXPECT_NEAR(kappa[2] / 0.40, 0.027093, 1e-6);
  AppearanceParameters p = cao2008(5);
  const OperatorConstants c(p);
  const Vec3<double> q = c.lms_from_rgb * Vec3<double>{5, 5, 5};
  const Vec3<long double> more = added(q, 5 * c.rod_white, c.kernel_scale, {kappa[0], kappa[1], kappa[2]});
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    long double step = 0;
    for (std::size_t j = 0; j < 3; ++j) step += c.rgb_from_lms[i][j] * more[j] / 5;
    std::printf("%s%+.4f", i ? ", " : "a grey of 5 cd/m2 would jump by ", static_cast<double>(step));
    largest = std::max(largest, std::abs(static_cast<double>(step)));
  }
  std::printf(" of itself in linear Rec.709\n");
  EXPECT_GT(largest, 0.02);
  // With it, nothing is left.
  p.adaptation = std::nextafter(5.0, 0.0);
  const Vec3<double> out = AppearanceReference(p)({{1, 1, 1}});
  for (const double x : out) EXPECT_NEAR(x, 1, 1e-9);
}

}  // namespace
}  // namespace scotopic::test

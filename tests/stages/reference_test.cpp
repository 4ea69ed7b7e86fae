#include "stages/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>

#include "support/primaries.h"

namespace scotopic {
namespace {

AppearanceParameters at(double adaptation) {
  AppearanceParameters p;
  p.adaptation = adaptation;
  p.white_luminance = adaptation / 0.18;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return p;
}

double luminance(const AppearanceReference& op, const Vec3<double>& rgb) {
  return dot(op.constants().luminance_from_rgb, rgb);
}

bool same_bits(const Vec3<double>& a, const Vec3<double>& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

TEST(Reference, a_grey_keeps_its_luminance_at_every_adaptation) {
  double worst = 0, where = 0;
  for (const RodEstimate rods : {RodEstimate::linear, RodEstimate::quadratic})
    for (double la = 1e-6; la <= 1e5; la *= 3.1) {
      auto p = at(la);
      p.rods = rods;
      const AppearanceReference op(p);
      for (double v = 1e-6; v < 1e4; v *= 7) {
        const double error = std::abs(luminance(op, op({{v, v, v}})) / v - 1);
        if (error > worst) worst = error, where = la;
      }
    }
  std::printf("grey: worst relative change of luminance %.3g at La %.3g\n", worst, where);
  EXPECT_LE(worst, 1e-6);
}

TEST(Reference, luminance_rises_with_the_input_along_rays) {
  const Vec3<double> rays[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}};
  for (const Model model : {Model::filament2021, Model::kirk2011})
    for (const double la : {1e-4, 0.001, 0.01, 0.1, 1.0}) {
      auto p = at(la);
      p.model = model;
      const AppearanceReference op(p);
      for (const auto& ray : rays) {
        double before = 0;
        for (double v = 1e-6; v < 1e4; v *= 1.01) {
          const double y = luminance(op, op({{v * ray[0], v * ray[1], v * ray[2]}}));
          ASSERT_GT(y, before) << la << " ray " << ray[0] << ray[1] << ray[2] << " at " << v;
          before = y;
        }
      }
    }
}

TEST(Reference, reds_darken_and_blues_lift_in_the_dark) {
  const AppearanceReference op(at(0.01));
  EXPECT_LT(luminance(op, op({{0.2, 0, 0}})), 0.6 * luminance(op, {0.2, 0, 0}));
  EXPECT_GT(luminance(op, op({{0, 0, 0.2}})), 1.5 * luminance(op, {0, 0, 0.2}));
}

TEST(Reference, black_stays_black) {
  for (const double la : {1e-6, 0.01, 1.0})
    EXPECT_EQ(AppearanceReference(at(la))({{0, 0, 0}}), (Vec3<double>{0, 0, 0}));
}

TEST(Reference, from_five_candelas_up_every_pixel_is_returned_bit_for_bit) {
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  for (const double la : {5.0, 10.0, 1e5})
    for (const Vec3<double>& rgb :
         {Vec3<double>{1, 0.5, 0.1}, {-1, -0.0, 5e-324}, {inf, 1, 1}, {nan, -inf, 2}, {1e308, 1e308, 1e308}})
      EXPECT_TRUE(same_bits(AppearanceReference(at(la))({rgb}), rgb));
}

TEST(Reference, a_lamp_of_five_candelas_in_the_dark_is_returned_bit_for_bit) {
  auto p = at(0.001);
  p.white_luminance = 1;
  EXPECT_TRUE(same_bits(AppearanceReference(p)({{9.0, 5.0, 1.0}}), {9.0, 5.0, 1.0}));
}

TEST(Reference, strength_nought_returns_every_pixel_bit_for_bit) {
  auto p = at(0.01);
  p.strength.all = 0;
  for (const Vec3<double>& rgb : {Vec3<double>{0.3, 0.2, 0.1}, {0, 0, 1}, {-0.1, 0.2, 0.0}})
    EXPECT_TRUE(same_bits(AppearanceReference(p)({rgb}), rgb)) << rgb[0] << " " << rgb[1] << " " << rgb[2];
}

TEST(Reference, each_effect_alone_has_its_own_switch) {
  const Vec3<double> rgb = {0.3, 0.2, 0.1};
  auto off = at(0.01);
  off.strength.shift = off.strength.luminance = off.strength.chroma = 0;
  EXPECT_TRUE(same_bits(AppearanceReference(off)({rgb}), rgb));
  for (double Strengths::*effect : {&Strengths::shift, &Strengths::luminance, &Strengths::chroma}) {
    auto p = off;
    p.strength.*effect = 1;
    const Vec3<double> full = AppearanceReference(p)({rgb});
    EXPECT_FALSE(same_bits(full, rgb));
    p.strength.*effect = 0.5;
    const Vec3<double> half = AppearanceReference(p)({rgb});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(half[i], (full[i] + rgb[i]) / 2, 0.02) << i;
  }
}

TEST(Reference, the_strength_of_all_mixes_result_and_input_so_that_a_slider_is_monotone) {
  for (const double la : {1.0, 0.1, 0.001})
    for (const Vec3<double>& rgb : {Vec3<double>{0.3, 0.2, 0.1}, {1, 0.02, 0.01}, {0.02, 0.1, 3}}) {
      auto p = at(la);
      const Vec3<double> full = AppearanceReference(p)({rgb});
      for (const double s : {0.0, 0.25, 0.5, 0.9}) {
        p.strength.all = s;
        const Vec3<double> mixed = AppearanceReference(p)({rgb});
        for (std::size_t i = 0; i < 3; ++i)
          EXPECT_NEAR(mixed[i], (1 - s) * rgb[i] + s * full[i],
                      1e-15 * std::abs(rgb[i]) + 1e-15 * std::abs(full[i]))
              << la << " " << s;
      }
    }
}

TEST(Reference, result_is_inside_the_gamut_or_no_further_out_than_the_input) {
  auto p = at(0.02);
  p.model = Model::kirk2011;
  p.luminance = LuminancePolicy::none;
  p.strength.chroma = 0;
  const AppearanceReference op(p);
  for (double r = -0.2; r < 1; r += 0.09)
    for (double g = -0.2; g < 1; g += 0.09)
      for (double b = -0.2; b < 1; b += 0.09) {
        const Vec3<double> out = op({{r, g, b}});
        ASSERT_GE(out[0], std::min(0.0, r));
        ASSERT_GE(out[1], std::min(0.0, g));
        ASSERT_GE(out[2], std::min(0.0, b));
      }
}

TEST(Reference, primaries_do_not_matter_to_a_named_gamut) {
  const auto p = at(0.05);
  auto q = p;
  q.xyz_from_rgb = test::rec2020;
  const Matrix3<double> wide_from_narrow = inverse(test::rec2020) * test::rec709;
  for (const Vec3<double>& rgb : {Vec3<double>{0.3, 0.2, 0.1}, {0, 0, 0.4}, {0.5, 0, 0}, {-0.01, 0.3, 0.1}}) {
    const Vec3<double> direct = wide_from_narrow * AppearanceReference(p)({rgb});
    const Vec3<double> other = AppearanceReference(q)({wide_from_narrow * rgb});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(direct[i], other[i], 1e-7);
  }
}

TEST(Reference, colours_that_are_no_light_stay_bounded_and_continuous) {
  const AppearanceReference op(at(0.01));
  Vec3<double> before = op({{-0.5, 0.1, 1.0}});
  double worst = 0;
  for (double r = -0.5; r < 0.5; r += 1e-5) {
    const Vec3<double> now = op({{r, 0.1, 1.0}});
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_LE(std::abs(now[i]), 100);
      worst = std::max(worst, std::abs(now[i] - before[i]) / 1e-5);
    }
    before = now;
  }
  std::printf("steepest slope through Y = 0: %.3g\n", worst);
  EXPECT_LE(worst, 500);
}

TEST(LuminanceRatio, is_exact_on_light_and_one_where_nothing_changes) {
  EXPECT_EQ(luminance_ratio(0.5, 0.25, 1), 0.5);
  EXPECT_EQ(luminance_ratio(-0.5, -0.25, 1), 0.5);
  EXPECT_EQ(luminance_ratio(-0.5, 0.25, 1), 0);
  for (const double from : {-1.0, -1e-3, 0.0, 1e-9, 1.0})
    EXPECT_NEAR(luminance_ratio(from, from, 1), 1, 3e-16);
  EXPECT_EQ(luminance_ratio(0, 0, 0), 1);
  for (const double to : {-1.0, 0.0, 1.0}) {
    double before = luminance_ratio(-2, to, 1);
    for (double from = -2; from < 2; from += 1e-4) {
      const double ratio = luminance_ratio(from, to, 1);
      ASSERT_GE(ratio, 0);
      ASSERT_LE(ratio, std::abs(to) / luminance_floor + 1);
      ASSERT_NEAR(ratio, before, 1.01e-4 * 2 * std::abs(to) / luminance_floor / luminance_floor + 0.02);
      before = ratio;
    }
  }
}

TEST(Reference, a_colour_of_negative_luminance_is_not_amplified) {
  for (const double la : {1e-4, 0.01, 1.0}) {
    const AppearanceReference op(at(la));
    for (const Vec3<double>& rgb : {Vec3<double>{0, -0.0565, 0.001}, {-0.3, -0.2, -0.1}, {0.2, -0.3, 0.1}}) {
      const Vec3<double> out = op({rgb});
      for (double x : out) EXPECT_LE(std::abs(x), 0.6) << la;
    }
  }
}

}  // namespace
}  // namespace scotopic

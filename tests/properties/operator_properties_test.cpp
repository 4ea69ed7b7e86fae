// What holds for every pixel through the whole operator, by the reference and by the batch.
#include <cmath>
#include <limits>

#include "properties/judge.h"
#include "properties/pixels.h"
#include "properties/property.h"
#include "receptors/receptor_space.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

TEST(OperatorProperties, black_stays_black) {
  for_all(
      cases(),
      [](Case c, Coverage& coverage) {
        c.planes = Planes::rgb;
        for (auto& x : c.sample.rgb) x = std::copysign(0.0f, x);
        coverage(name(c.regime));
        coverage("minus zero", std::signbit(c.sample.rgb[0]));
        RC_ASSERT(largest(AppearanceReference(c.parameters)(c.sample.widened(c.planes))) == 0);
        RC_ASSERT(largest(applied(AppearanceBatch(c.parameters), c)) == 0);
        RC_ASSERT(largest(applied(AppearanceBatch(c.parameters, Precision::dual), c)) == 0);
      },
      all_regimes({}, {{"minus zero", 0.1}}));
}

TEST(OperatorProperties, finite_stays_finite) {
  for_all(
      cases(),
      [](const Case& c, Coverage& coverage) {
        coverage(name(c.regime));
        coverage("beyond the limit", largest(c.sample.rgb) > operable_limit);
        const auto check = [](const auto& out) {
          for (const auto x : out) RC_ASSERT(std::isfinite(x));
        };
        check(AppearanceReference(c.parameters)(c.sample.widened(c.planes)));
        check(applied(AppearanceBatch(c.parameters), c));
        check(applied(AppearanceBatch(c.parameters, Precision::dual), c));
      },
      all_regimes({}, {{"beyond the limit", 0.001}}));
}

TEST(OperatorProperties, a_component_that_is_not_finite_or_too_large_keeps_every_bit_of_the_pixel) {
  for_all(
      cases(),
      [](Case c, Coverage& coverage) {
        Random random(bits(c.sample.rgb)[0] + 977u * bits(c.sample.rgb)[2]);
        constexpr float inf = std::numeric_limits<float>::infinity();
        const float bad[] = {inf, -inf, std::numeric_limits<float>::quiet_NaN(), 0x1.000002p120f, -3e38f};
        const float value = bad[random.below(5)];
        const int where = random.below(c.planes == Planes::rgb ? 3 : c.planes == Planes::rgb_rod ? 4 : 7);
        if (where < 3) c.sample.rgb[static_cast<std::size_t>(where)] = value;
        else if (where == 3) c.sample.rod = value;
        else c.sample.cones[static_cast<std::size_t>(where - 4)] = value;
        coverage("rod or cone", where >= 3);
        coverage("NaN", std::isnan(value));
        const auto pixel = c.sample.widened(c.planes);
        RC_ASSERT(bits(AppearanceReference(c.parameters)(pixel)) == bits(pixel.rgb));
        for (const Precision precision : {Precision::single, Precision::dual}) {
          std::uint8_t touched = 1;
          RC_ASSERT(bits(applied(AppearanceBatch(c.parameters, precision), c, &touched)) == bits(c.sample.rgb));
          RC_ASSERT(touched == 0);
        }
      },
      {{"rod or cone", 0.1}, {"NaN", 0.1}});
}

TEST(OperatorProperties, without_rods_the_shift_keeps_every_bit) {
  for_all(
      cases({Regime::huge}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        c.parameters.luminance = LuminancePolicy::none;
        c.parameters.strength.chroma = 0;
        if (c.planes == Planes::rgb) c.planes = Planes::rgb_rod;
        c.sample.rod = -std::abs(c.sample.rod) * (c.regime == Regime::negative ? 1.0f : 0.0f);
        coverage(name(c.regime));
        const auto pixel = c.sample.widened(c.planes);
        RC_ASSERT(AppearanceReference(c.parameters)(pixel) == pixel.rgb);  // -0 may become 0
        RC_ASSERT(applied(AppearanceBatch(c.parameters), c) == c.sample.rgb);
        RC_ASSERT(applied(AppearanceBatch(c.parameters, Precision::dual), c) == c.sample.rgb);
      },
      all_regimes({Regime::huge}));
}

TEST(OperatorProperties, strength_0_keeps_every_bit) {
  for_all(
      cases({Regime::huge}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.parameters.strength.all = 0;
        coverage(name(c.regime));
        const auto pixel = c.sample.widened(c.planes);
        RC_ASSERT(AppearanceReference(c.parameters)(pixel) == pixel.rgb);
        RC_ASSERT(applied(AppearanceBatch(c.parameters), c) == c.sample.rgb);
        RC_ASSERT(applied(AppearanceBatch(c.parameters, Precision::dual), c) == c.sample.rgb);
      },
      all_regimes({Regime::huge}));
}

TEST(OperatorProperties, from_5_candelas_up_every_bit_is_kept) {
  for_all(
      cases({Regime::huge}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        Random random(bits(c.sample.rgb)[2] + 1);
        const bool bright_eye = random.chance(0.3);
        if (bright_eye) c.parameters.adaptation = random.chance(0.2) ? 5 : random.log_uniform(5, 1e6);
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        const double local = local_luminance(op, pixel.rgb);
        const bool photopic = local >= 5, surely = local >= 5.00001;
        coverage("adapted", bright_eye);
        coverage("a lamp in the dark", !bright_eye && surely);
        coverage("just there", photopic && local < 5.001);
        if (photopic) RC_ASSERT(bits(op(pixel)) == bits(pixel.rgb));
        // In float the sum La + unit Y is itself rounded: within 2e-6 of 5 a pixel may fall on either side.
        if (!surely) return;
        std::uint8_t touched = 1;
        RC_ASSERT(bits(applied(AppearanceBatch(c.parameters), c, &touched)) == bits(c.sample.rgb));
        RC_ASSERT(touched == 0);
      },
      {{"adapted", 0.2}, {"a lamp in the dark", 0.05}, {"just there", 0.02}});
}

TEST(OperatorProperties, a_lamp_of_100_in_a_dark_scene_keeps_its_chroma) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        AppearanceParameters p;
        p.model = random.chance(0.5) ? Model::filament2021 : Model::kirk2011;
        p.adaptation = random.log_uniform(1e-4, 1e-2);
        p.white_luminance = p.adaptation / 0.18;
        p.xyz_from_rgb = rec709;
        p.xyz_from_gamut = rec709;
        const AppearanceReference op(p);
        Vec3<double> rgb = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
        const double cdm2 = random.chance(0.5) ? 100 : random.log_uniform(4.9, 100);
        const double scale = cdm2 / (luminance(op, rgb) * p.white_luminance);
        for (auto& x : rgb) x *= scale;
        const auto out = op({rgb});
        const auto chroma = [&](const Vec3<double>& v) {
          const double y = luminance(op, v);
          return std::hypot(v[0] - y, v[1] - y, v[2] - y);
        };
        coverage("below 5", cdm2 + p.adaptation < 5);
        RC_ASSERT(chroma(out) >= 0.9 * chroma(rgb));
      },
      {{"below 5", 0.002}});
}

TEST(OperatorProperties, at_a_millionth_of_a_candela_the_shift_is_a_3x3_matrix) {
  // All gains are 1 there: XYZ' = (1 + XYZ_from_LMS A^-1 N (1 1 1)' r) XYZ, r linear in XYZ. filament2021 has some 400
  // times as many kernel units in a cd/m2 and comes there at a billionth.
  double worst = 0;
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        const bool kirk = random.chance(0.5);
        AppearanceParameters p;
        p.model = kirk ? Model::kirk2011 : Model::filament2021;
        p.adaptation = 1e-6;
        p.white_luminance = random.log_uniform(1e-8, 1e-4);
        p.luminance = LuminancePolicy::none;
        p.strength.chroma = 0;
        p.xyz_from_rgb = random.chance(0.5) ? rec709 : rec2020;
        const AppearanceReference op(p);
        const OperatorConstants& c = op.constants();
        Vec3<double> rgb;
        for (auto& x : rgb) x = random.uniform(0, 1);
        // The rods' row, from the published fit; the floor at .016 Y is another row.
        const Vec3<double> scotopic = transpose(p.xyz_from_rgb) * scotopic_linear_from_xyz;
        if (dot(scotopic, rgb) < 0.02 * luminance(op, rgb)) return;
        double r = rod_signal_per_scotopic_luminance() * dot(scotopic, rgb);
        const double brightest = (largest(c.lms_from_rgb * rgb) + c.kernel.kappa()[2] * r) * p.white_luminance;
        const double scale = (kirk ? 1e-6 : 1e-9) * random.log_uniform(1e-3, 1) / brightest;
        for (auto& x : rgb) x *= scale;
        r *= scale;
        const auto added = c.rgb_from_lms * (c.kernel.cone_shift() * Vec3<double>{r, r, r});
        const Vec3<double> expected = {rgb[0] + added[0], rgb[1] + added[1], rgb[2] + added[2]};
        const double error = distance(op({rgb}), expected) / largest(expected);
        coverage("kirk2011", kirk);
        coverage("filament2021", !kirk);
        worst = std::max(worst, error);
        RC_ASSERT(error <= 1e-5);
      },
      {{"kirk2011", 0.3}, {"filament2021", 0.3}});
  std::printf("scotopic limit: worst difference from its matrix %.2g\n", worst);
}

TEST(OperatorProperties, below_the_mesopic_range_what_the_rods_do_not_see_is_black) {
  // m = 0 there, to the last bit: the luminance is the rods', and that of no rods is 0.
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        Random random(bits(c.sample.rgb)[0] + 11);
        c.planes = Planes::rgb_rod;
        c.sample.rod = random.chance(0.5) ? 0.0f : -0.0f;
        c.parameters.luminance = LuminancePolicy::mesopic;
        c.parameters.strength.all = c.parameters.strength.luminance = 1;
        c.parameters.adaptation = random.log_uniform(1e-6, 0.002);
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        if (local_luminance(op, pixel.rgb) > 0.00202) return;
        coverage("light");
        RC_ASSERT(largest(op(pixel)) == 0);
        RC_ASSERT(largest(applied(AppearanceBatch(c.parameters), c)) == 0);
        RC_ASSERT(largest(applied(AppearanceBatch(c.parameters, Precision::dual), c)) == 0);
      },
      {{"light", 0.1}});
}

TEST(OperatorProperties, a_grey_stays_on_the_line_of_hue_that_its_shift_puts_it_on) {
  // Luminance scales and chroma moves towards white: neither turns the colour that rods give a grey.
  for_all(
      cases({Regime::huge, Regime::subnormal}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec709;
        c.parameters.xyz_from_gamut.reset();
        c.parameters.strength.shift = c.parameters.strength.all = 1;
        const float v = std::abs(c.sample.rgb[0]);
        c.sample.rgb = {v, v, v};
        Case shift_alone = c;
        shift_alone.parameters.luminance = LuminancePolicy::none;
        shift_alone.parameters.strength.chroma = 0;
        const auto pixel = c.sample.widened(c.planes);
        const auto colour = [&](const AppearanceReference& op) {
          const auto out = op(pixel);
          const double y = luminance(op, out);
          return Vec3<double>{out[0] - y, out[1] - y, out[2] - y};
        };
        const auto whole = colour(AppearanceReference(c.parameters));
        const auto line = colour(AppearanceReference(shift_alone.parameters));
        const double size = largest(whole) * largest(line);
        if (!(size > 1e-20 * v * v)) return;
        coverage("coloured");
        coverage("faded", c.parameters.strength.chroma > 0);
        RC_ASSERT(dot(whole, line) > 0);
        RC_ASSERT(largest(cross(whole, line)) <= 1e-14 * size + 1e-14 * v * (largest(whole) + largest(line)));
      },
      {{"coloured", 0.5}, {"faded", 0.3}});
}

TEST(OperatorProperties, only_absolute_light_counts) {
  // Half the unit and twice the values are the same light: the same digits come out.
  for_all(
      cases({Regime::huge, Regime::subnormal, Regime::tiny}),
      [](const Case& c, Coverage& coverage) {
        Random random(bits(c.sample.rgb)[0]);
        const int k = random.below(9) - 4;
        Case other = c;
        const auto s = static_cast<float>(std::exp2(k));
        for (auto& x : other.sample.rgb) x *= s;
        for (auto& x : other.sample.cones) x *= s;
        other.sample.rod *= s;
        other.parameters.white_luminance /= static_cast<double>(s);
        coverage(name(c.regime));
        const auto a = AppearanceReference(c.parameters)(c.sample.widened(c.planes));
        const auto b = AppearanceReference(other.parameters)(other.sample.widened(other.planes));
        if (largest(c.sample.rgb) >= 0x1p115) return;
        for (std::size_t i = 0; i < 3; ++i)
          RC_ASSERT(std::abs(a[i] * static_cast<double>(s) - b[i]) <= 1e-11 * std::max(largest(b), largest(other.sample.rgb)));
        const auto narrow = applied(AppearanceBatch(c.parameters, Precision::dual), c);
        if (largest(narrow) == 0 || largest(narrow) < 1e-30) return;
        const auto narrow_other = applied(AppearanceBatch(other.parameters, Precision::dual), other);
        for (std::size_t i = 0; i < 3; ++i)
          RC_ASSERT(std::abs(narrow[i] * s - narrow_other[i]) <= 1.3e-7f * static_cast<float>(std::max(largest(narrow_other), largest(other.sample.rgb))));
      },
      all_regimes({Regime::huge, Regime::subnormal, Regime::tiny}));
}

TEST(OperatorProperties, the_working_space_does_not_matter) {
  for_all(
      cases({Regime::huge, Regime::subnormal, Regime::tiny, Regime::mixed_exponents}),
      [](Case c, Coverage& coverage) {
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec709;
        if (c.parameters.xyz_from_gamut) c.parameters.xyz_from_gamut = rec709;
        Case other = c;
        other.parameters.xyz_from_rgb = rec2020;
        const Matrix3<double> to = inverse(rec2020) * rec709, back = inverse(to);
        const auto pixel = c.sample.widened(c.planes);
        const auto direct = AppearanceReference(c.parameters)(pixel);
        const auto around = back * AppearanceReference(other.parameters)({to * pixel.rgb});
        coverage(name(c.regime));
        const double size = std::max({largest(pixel.rgb), largest(direct), 1e-300});
        const bool light = is_light(c);
        coverage("light", light);
        RC_ASSERT(distance(direct, around) <= (light ? 1e-12 : 1e-6) * size);
      },
      all_regimes({Regime::huge, Regime::subnormal, Regime::tiny, Regime::mixed_exponents}, {{"light", 0.3}}));
}

TEST(OperatorProperties, the_photopic_policy_keeps_the_luminance_of_light) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec709;
        c.parameters.xyz_from_gamut = rec709;
        c.parameters.luminance = LuminancePolicy::photopic;
        c.parameters.strength.luminance = 1;
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        coverage("light");
        coverage("kirk2011", c.parameters.model == Model::kirk2011);
        RC_ASSERT(std::abs(luminance(op, op(pixel)) / luminance(op, pixel.rgb) - 1) <= 1e-12);
      },
      {{"light", 0.3}, {"kirk2011", 0.1}});
}

TEST(OperatorProperties, the_mesopic_policy_lies_between_cones_and_rods) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec709;
        c.parameters.xyz_from_gamut = rec709;
        c.parameters.luminance = LuminancePolicy::mesopic;
        c.parameters.strength.luminance = 1;
        c.parameters.strength.all = 1;
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        const double cones = luminance(op, pixel.rgb);
        const double rods = rod_signal_from_rgb(op.constants(), pixel.rgb) / op.constants().rod_white;
        const double out = luminance(op, op(pixel));
        coverage("rods see less", rods < 0.9 * cones);
        coverage("rods see more", rods > 1.1 * cones);
        RC_ASSERT(out >= std::min(cones, rods) * (1 - 1e-12) && out <= std::max(cones, rods) * (1 + 1e-12));
      },
      {{"rods see less", 0.1}, {"rods see more", 0.05}});
}

TEST(OperatorProperties, a_grey_keeps_its_luminance) {
  for_all(
      cases({Regime::huge, Regime::subnormal}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec2020;
        c.parameters.xyz_from_gamut = rec709;
        c.parameters.luminance = LuminancePolicy::mesopic;
        c.parameters.strength.luminance = 1;
        c.parameters.sp_ratio = sp_ratio_d65;
        const float v = std::abs(c.sample.rgb[0]);
        c.sample.rgb = {v, v, v};
        const AppearanceReference op(c.parameters);
        const double y = luminance(op, c.sample.widened(c.planes).rgb);
        coverage("light", v > 0);
        RC_ASSERT(std::abs(luminance(op, op(c.sample.widened(c.planes))) - y) <= 1e-13 * y);
      },
      {{"light", 0.5}});
}

TEST(OperatorProperties, more_of_a_light_never_looks_darker) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec709;
        c.parameters.xyz_from_gamut = rec709;
        c.parameters.strength.luminance = 1;
        if (c.parameters.luminance == LuminancePolicy::none) c.parameters.luminance = LuminancePolicy::mesopic;
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        auto pixel = c.sample.widened(c.planes);
        const double before = luminance(op, op(pixel));
        Random random(bits(c.sample.rgb)[0]);
        const double k = 1 + random.log_uniform(1e-6, 10);
        for (auto& x : pixel.rgb) x *= k;
        coverage("mesopic", c.parameters.luminance == LuminancePolicy::mesopic && c.parameters.weight == Weight::local);
        RC_ASSERT(luminance(op, op(pixel)) >= before * (1 - 1e-12));
      },
      {{"mesopic", 0.2}});
}

TEST(OperatorProperties, what_was_in_the_gamut_stays_there) {
  // Shift and projection; the luminance stage scales, which keeps signs, and chroma moves towards white.
  for_all(
      cases({Regime::huge}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        c.planes = Planes::rgb;
        c.parameters.xyz_from_rgb = rec709;
        c.parameters.xyz_from_gamut = rec709;
        for (auto& x : c.sample.rgb) x = std::abs(x);
        coverage(name(c.regime));
        for (const double x : AppearanceReference(c.parameters)(c.sample.widened(c.planes))) RC_ASSERT(x >= 0);
        for (const float x : applied(AppearanceBatch(c.parameters), c)) RC_ASSERT(x >= 0);
      },
      all_regimes({Regime::huge}));
}

TEST(OperatorProperties, float_and_double_agree) {
  for_all(
      cases(),
      [](const Case& c, Coverage& coverage) {
        const auto a = applied(AppearanceBatch(c.parameters), c);
        const auto b = applied(AppearanceBatch(c.parameters, Precision::dual), c);
        coverage(name(c.regime));
        const double size = std::max({size_in(c.sample, c.planes), largest(b), 0x1p-120});
        for (std::size_t i = 0; i < 3; ++i)
          RC_ASSERT(std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])) <= 5e-6 * size);
      },
      all_regimes());
}

}  // namespace
}  // namespace scotopic::test

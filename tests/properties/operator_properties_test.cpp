// What holds for every pixel through the whole operator, by the reference and by the batch.
#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/judge.h"
#include "properties/pixels.h"
#include "properties/property.h"
#include "receptors/receptor_space.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

/// What a colour differs by from the grey of its luminance.
Vec3<double> colour_of(const AppearanceReference& op, const Vec3<double>& rgb) {
  const double y = luminance(op, rgb);
  return {rgb[0] - y, rgb[1] - y, rgb[2] - y};
}

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
  for_all(cases(),
          [](Case c, Coverage& coverage) {
            Random random(bits(c.sample.rgb)[0] + 977u * bits(c.sample.rgb)[2]);
            constexpr float inf = std::numeric_limits<float>::infinity();
            const float bad[] = {inf, -inf, std::numeric_limits<float>::quiet_NaN(), 0x1.000002p120f, -3e38f};
            const float value = bad[random.below(5)];
            const int where = random.below(c.planes == Planes::rgb ? 3 : c.planes == Planes::rgb_rod ? 4 : 7);
            if (where < 3)
              c.sample.rgb[static_cast<std::size_t>(where)] = value;
            else if (where == 3)
              c.sample.rod = value;
            else
              c.sample.cones[static_cast<std::size_t>(where - 4)] = value;
            coverage("rod or cone", where >= 3);
            coverage("NaN", std::isnan(value));
            const auto pixel = c.sample.widened(c.planes);
            RC_ASSERT(bits(AppearanceReference(c.parameters)(pixel)) == bits(pixel.rgb));
            for (const Precision precision : {Precision::single, Precision::dual}) {
              std::uint8_t touched = 1;
              RC_ASSERT(bits(applied(AppearanceBatch(c.parameters, precision), c, &touched)) ==
                        bits(c.sample.rgb));
              RC_ASSERT(touched == 0);
            }
          },
          {{"rod or cone", 0.1}, {"NaN", 0.1}});
}

TEST(OperatorProperties, without_rods_the_shift_changes_no_number_and_no_bit_but_minus_0s_sign) {
  // -0 + 0 is +0, and the shift adds its 0.
  const auto kept = [](const auto& out, const auto& in) {
    for (std::size_t i = 0; i < 3; ++i)
      if (out[i] != in[i] || (in[i] != 0 && std::signbit(out[i]) != std::signbit(in[i]))) return false;
    return true;
  };
  for_all(
      cases({Regime::huge}),
      [&](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        c.parameters.luminance = LuminancePolicy::none;
        c.parameters.strength.chroma = 0;
        if (c.planes == Planes::rgb) c.planes = Planes::rgb_rod;
        c.sample.rod = -std::abs(c.sample.rod) * (c.regime == Regime::negative ? 1.0f : 0.0f);
        coverage(name(c.regime));
        const auto pixel = c.sample.widened(c.planes);
        RC_ASSERT(kept(AppearanceReference(c.parameters)(pixel), pixel.rgb));
        RC_ASSERT(kept(applied(AppearanceBatch(c.parameters), c), c.sample.rgb));
        RC_ASSERT(kept(applied(AppearanceBatch(c.parameters, Precision::dual), c), c.sample.rgb));
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
        for (const float x : c.sample.rgb) coverage("minus zero", x == 0 && std::signbit(x));
        const auto pixel = c.sample.widened(c.planes);
        RC_ASSERT(bits(AppearanceReference(c.parameters)(pixel)) == bits(pixel.rgb));
        RC_ASSERT(bits(applied(AppearanceBatch(c.parameters), c)) == bits(c.sample.rgb));
        RC_ASSERT(bits(applied(AppearanceBatch(c.parameters, Precision::dual), c)) == bits(c.sample.rgb));
      },
      all_regimes({Regime::huge}, {{"minus zero", 0.02}}));
}

TEST(OperatorProperties, from_5_candelas_up_every_bit_is_kept) {
  for_all(cases({Regime::huge}),
          [](Case c, Coverage& coverage) {
            if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
            Random random(bits(c.sample.rgb)[2] + 1);
            const bool bright_eye = random.chance(0.3);
            if (bright_eye) c.parameters.adaptation = random.chance(0.2) ? 5 : random.log_uniform(5, 1e6);
            const AppearanceReference op(c.parameters);
            const auto pixel = c.sample.widened(c.planes);
            const double local = local_luminance(op, pixel.rgb);
            RC_PRE(local >= 5);
            coverage("adapted", bright_eye);
            coverage("just there", local < 5.001);
            RC_ASSERT(bits(op(pixel)) == bits(pixel.rgb));
            // In float the sum La + unit Y is itself rounded: within 2e-6 of 5 a pixel may fall on either
            // side.
            if (local >= 5.00001) {
              std::uint8_t touched = 1;
              RC_ASSERT(bits(applied(AppearanceBatch(c.parameters), c, &touched)) == bits(c.sample.rgb));
              RC_ASSERT(touched == 0);
              coverage("a lamp in the dark, in float, too", !bright_eye);
            }
          },
          {{"adapted", 0.2}, {"a lamp in the dark, in float, too", 0.2}, {"just there", 0.02}});
}

TEST(OperatorProperties, a_lamp_of_100_in_a_dark_scene_keeps_its_chroma) {
  for_all(seeds(),
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

/// How much of a lamp's own colour is left: its share in its own direction, over luminance.
double kept_chroma(const AppearanceReference& op, const Vec3<double>& lamp) {
  const auto own = colour_of(op, lamp), seen = colour_of(op, op({lamp, {}, {}}));
  return dot(own, seen) / dot(own, own);
}

TEST(OperatorProperties,
     a_lamp_below_5_keeps_a_stated_share_of_its_colour_and_more_than_one_weight_for_the_scene_leaves) {
  // filament2021, a scene of .001 cd/m2. (kirk2011 adds a blue of its own of several times a dim lamp's
  // colour.)
  constexpr double cdm2[] = {1, 2, 3, 4, 4.9}, kept[] = {0.3, 0.6, 0.8, 0.92, 0.98};
  double least[5] = {9, 9, 9, 9, 9}, least_more = 9;
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        AppearanceParameters p;
        p.adaptation = 0.001;
        p.white_luminance = random.log_uniform(1e-3, 1e3);
        const WorkingSpace& space = any_space(random);
        coverage(space.name);
        p.xyz_from_rgb = p.xyz_from_gamut.emplace(space.xyz_from_rgb);
        const AppearanceReference local(p);
        p.weight = Weight::global;
        const AppearanceReference global(p);
        const bool warm = random.chance(0.5);
        Vec3<double> rgb =
            warm ? Vec3<double>{1, random.uniform(0.3, 0.9), random.uniform(0, 0.6)}
                 : Vec3<double>{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
        RC_PRE(largest(colour_of(local, rgb)) > 0.1 * largest(rgb));
        coverage("warm", warm);
        const auto k = static_cast<std::size_t>(random.below(5));
        const double scale = cdm2[k] / (luminance(local, rgb) * p.white_luminance);
        for (auto& x : rgb) x *= scale;
        const double share = kept_chroma(local, rgb), share_global = kept_chroma(global, rgb);
        least[k] = std::min(least[k], share);
        least_more = std::min(least_more, share - share_global);
        RC_ASSERT(share >= kept[k]);
        RC_ASSERT(share >= share_global + 0.25);
      },
      all_working_spaces({{"warm", 0.3}}));
  for (std::size_t k = 0; k < 5; ++k)
    std::printf("a lamp of %g cd/m2 keeps %.3f and more of its colour\n", cdm2[k], least[k]);
  std::printf("at global weight less by %.3f at least\n", least_more);
}

TEST(OperatorProperties, at_a_millionth_of_a_candela_the_shift_is_a_3x3_matrix) {
  // All gains are 1 there: XYZ' = (1 + XYZ_from_LMS A^-1 N (1 1 1)' r) XYZ, r linear in XYZ. filament2021 has
  // some 400 times as many kernel units in a cd/m2 and comes there at a billionth.
  double worst = 0;
  for_all(seeds(),
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
            RC_PRE(dot(scotopic, rgb) >= 0.02 * luminance(op, rgb));
            double r = rod_signal_per_scotopic_luminance() * dot(scotopic, rgb);
            const double brightest =
                (largest(c.lms_from_rgb * rgb) + c.kernel.kappa()[2] * r) * p.white_luminance;
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
  for_all(cases(no_light),
          [](Case c, Coverage& coverage) {
            if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
            Random random(bits(c.sample.rgb)[0] + 11);
            c.planes = Planes::rgb_rod;
            c.sample.rod = random.chance(0.5) ? 0.0f : -0.0f;
            c.parameters.luminance = LuminancePolicy::mesopic;
            c.parameters.strength.all = c.parameters.strength.luminance = 1;
            c.parameters.adaptation = random.log_uniform(1e-6, 0.002);
            const AppearanceReference op(c.parameters);
            const double y = luminance(op, c.sample.widened(c.planes).rgb) * c.parameters.white_luminance;
            const double room = 0.00202 - c.parameters.adaptation;
            const auto dimmed = static_cast<float>(y > room ? room / y * random.uniform(0, 1) : 1);
            for (auto& x : c.sample.rgb) x *= dimmed;
            const auto pixel = c.sample.widened(c.planes);
            // Not at the very floor: there float may see a little less luminance.
            RC_PRE(is_light(c, 1.0001 * luminance_floor));
            coverage("minus no rods", std::signbit(c.sample.rod));
            coverage("brighter than the eye is adapted to",
                     luminance(op, pixel.rgb) * c.parameters.white_luminance > c.parameters.adaptation);
            RC_ASSERT(largest(op(pixel)) == 0);
            RC_ASSERT(largest(applied(AppearanceBatch(c.parameters), c)) == 0);
            RC_ASSERT(largest(applied(AppearanceBatch(c.parameters, Precision::dual), c)) == 0);
          },
          {{"minus no rods", 0.3}, {"brighter than the eye is adapted to", 0.2}});
}

TEST(OperatorProperties, a_grey_is_exact_through_all_stages_and_ends_on_the_line_of_hue_of_its_exact_shift) {
  // Luminance scales and chroma moves towards white: neither turns the colour that rods and the gamut give a
  // grey. The line, and the result, are of the operator that was written a second time.
  using Real = long double;
  struct Setting {
    AppearanceReference op;
    ExactOperator<Real> exact, shift_alone;
    const char* space;
  };
  std::vector<Setting> settings;
  Random random(21);
  for (int i = 0; i < 300; ++i) {
    AppearanceParameters p = draw_parameters(random);
    if (p.model == Model::safko2019) p.model = Model::kirk2011;
    const WorkingSpace& space = any_space(random);
    p.xyz_from_rgb = space.xyz_from_rgb;
    if (p.xyz_from_gamut)
      p.xyz_from_gamut = random.chance(0.5) ? space.xyz_from_rgb : any_space(random).xyz_from_rgb;
    p.strength.shift = std::max(p.strength.shift, 0.1);
    p.strength.all = std::max(p.strength.all, 0.1);
    AppearanceParameters alone = p;
    alone.luminance = LuminancePolicy::none;
    alone.strength.chroma = 0;
    settings.push_back(
        {AppearanceReference(p), ExactOperator<Real>(p), ExactOperator<Real>(alone), space.name});
  }
  double worst = 0, most_turned = 0;
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random draws(seed);
        const Setting& s = settings[static_cast<std::size_t>(draws.below(300))];
        const auto& p = s.op.constants().parameters;
        const double v = draws.log_uniform(1e-6, 5) / p.white_luminance;
        const ReferencePixel grey = {{v, v, v}, {}, {}};
        const auto narrow = [](const Vec3<Real>& x) {
          return Vec3<double>{static_cast<double>(x[0]), static_cast<double>(x[1]),
                              static_cast<double>(x[2])};
        };
        const auto got = s.op(grey), shifted = narrow(s.shift_alone(grey));
        const double error = distance(got, narrow(s.exact(grey))) / std::max(largest(got), v);
        worst = std::max(worst, error);
        RC_ASSERT(error <= 2e-13);
        const auto colour = colour_of(s.op, got), line = colour_of(s.op, shifted);
        RC_PRE(largest(colour) > 1e-3 * largest(got) && largest(line) > 1e-3 * largest(shifted));
        const double turned =
            std::sqrt(dot(cross(colour, line), cross(colour, line)) / dot(colour, colour) / dot(line, line));
        most_turned = std::max(most_turned, turned);
        coverage(s.space);
        coverage("faded", p.strength.chroma > 0);
        coverage("scaled", p.luminance != LuminancePolicy::none && p.strength.luminance > 0);
        coverage("on a face of its gamut",
                 p.xyz_from_gamut && *std::min_element(shifted.begin(), shifted.end()) < 1e-12 * v);
        RC_ASSERT(dot(colour, line) > 0);
        RC_ASSERT(turned <= 1e-10);
      },
      all_working_spaces({{"faded", 0.3}, {"scaled", 0.5}, {"on a face of its gamut", 0.01}}));
  std::printf("greys: worst %.2g of the largest component, off their line of hue by %.2g\n", worst,
              most_turned);
}

TEST(OperatorProperties,
     no_gamut_turns_the_hue_of_a_grey_under_filament2021_nor_by_more_than_stated_under_kirk2011) {
  // The opponent angle, red-green against blue-yellow: of the shift alone, and in the gamut of each working
  // space.
  constexpr double most_turned[2][4] = {{1e-6, 1e-6, 1e-6, 1e-6}, {34, 24, 23, 5}};
  double turned[2][4] = {};
  for_all(seeds(),
          [&](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const bool kirk = random.chance(0.5);
            AppearanceParameters p;
            p.model = kirk ? Model::kirk2011 : Model::filament2021;
            p.adaptation = random.log_uniform(1e-6, 4.8);
            p.white_luminance = 1;
            p.weight = random.chance(0.5) ? Weight::local : Weight::global;
            p.luminance = random.chance(0.5) ? LuminancePolicy::none : LuminancePolicy::mesopic;
            p.strength.all = random.chance(0.5) ? 1 : random.uniform(0.01, 1);
            const auto g = static_cast<std::size_t>(random.below(4));
            p.xyz_from_rgb = working_spaces[g].xyz_from_rgb;
            const AppearanceReference free(p);
            p.xyz_from_gamut = p.xyz_from_rgb;
            const AppearanceReference held(p);
            const double v = random.log_uniform(1e-6, 5);
            RC_PRE(local_luminance(free, {v, v, v}) < 4.9);
            const auto hue = [&](const AppearanceReference& op) {
              const auto o =
                  opponent_from_lms * (op.constants().lms_from_rgb * colour_of(op, op({{v, v, v}, {}, {}})));
              return std::atan2(o[1], o[0]) * 57.29577951308232;
            };
            const double turn = std::abs(hue(free) - hue(held));
            turned[kirk][g] = std::max(turned[kirk][g], turn);
            coverage("kirk2011", kirk);
            coverage("filament2021", !kirk);
            RC_ASSERT(turn <= most_turned[kirk][g]);
          },
          {{"filament2021", 0.4}, {"kirk2011", 0.4}});
  for (std::size_t g = 0; g < 4; ++g)
    std::printf("%s turns the hue of a grey by %.2g, under kirk2011 by %.3g degrees at most\n",
                working_spaces[g].name, turned[0][g], turned[1][g]);
}

TEST(OperatorProperties, only_absolute_light_counts) {
  // Half the unit and twice the values are the same light: the same digits come out.
  for_all(
      cases({Regime::huge, Regime::subnormal, Regime::tiny}),
      [](const Case& c, Coverage& coverage) {
        Random random(bits(c.sample.rgb)[0]);
        const int k = random.below(9) - 4;
        RC_PRE(largest(c.sample.rgb) < 0x1p115);
        Case other = c;
        const auto s = static_cast<float>(std::exp2(k));
        for (auto& x : other.sample.rgb) x *= s;
        for (auto& x : other.sample.cones) x *= s;
        other.sample.rod *= s;
        other.parameters.white_luminance /= static_cast<double>(s);
        coverage(name(c.regime));
        const auto a = AppearanceReference(c.parameters)(c.sample.widened(c.planes));
        const auto b = AppearanceReference(other.parameters)(other.sample.widened(other.planes));
        for (std::size_t i = 0; i < 3; ++i)
          RC_ASSERT(std::abs(a[i] * static_cast<double>(s) - b[i]) <=
                    1e-11 * std::max(largest(b), largest(other.sample.rgb)));
        const auto narrow = applied(AppearanceBatch(c.parameters, Precision::dual), c);
        if (largest(narrow) >= 1e-30) {
          coverage("rounded to float, too");
          const auto narrow_other = applied(AppearanceBatch(other.parameters, Precision::dual), other);
          const double size = std::max(largest(narrow_other), largest(other.sample.rgb));
          for (std::size_t i = 0; i < 3; ++i)
            RC_ASSERT(std::abs(narrow[i] * s - narrow_other[i]) <= 1.3e-7f * static_cast<float>(size));
        }
      },
      all_regimes({Regime::huge, Regime::subnormal, Regime::tiny}, {{"rounded to float, too", 0.9}}));
}

TEST(OperatorProperties, the_working_space_does_not_matter) {
  for_all(
      cases({Regime::huge, Regime::subnormal, Regime::tiny, Regime::mixed_exponents}),
      [](Case c, Coverage& coverage) {
        c.planes = Planes::rgb;
        Random random(bits(c.sample.rgb)[0] + 13);
        const WorkingSpace &from = any_space(random), &into = any_space(random);
        c.parameters.xyz_from_rgb = from.xyz_from_rgb;
        if (c.parameters.xyz_from_gamut) c.parameters.xyz_from_gamut = from.xyz_from_rgb;
        Case other = c;
        other.parameters.xyz_from_rgb = into.xyz_from_rgb;
        const Matrix3<double> to = inverse(into.xyz_from_rgb) * from.xyz_from_rgb, back = inverse(to);
        coverage(into.name);
        const auto pixel = c.sample.widened(c.planes);
        const auto direct = AppearanceReference(c.parameters)(pixel);
        const auto around = back * AppearanceReference(other.parameters)({to * pixel.rgb});
        coverage(name(c.regime));
        const double size = std::max({largest(pixel.rgb), largest(direct), 1e-300});
        const bool light = is_light(c);
        coverage("light", light);
        RC_ASSERT(distance(direct, around) <= (light ? 1e-12 : 1e-6) * size);
      },
      all_regimes({Regime::huge, Regime::subnormal, Regime::tiny, Regime::mixed_exponents},
                  all_working_spaces({{"light", 0.3}})));
}

TEST(OperatorProperties, the_photopic_policy_keeps_the_luminance_of_light) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.planes = Planes::rgb;
        Random random(bits(c.sample.rgb)[0] + 17);
        const WorkingSpace& space = any_space(random);
        c.parameters.xyz_from_rgb = space.xyz_from_rgb;
        c.parameters.xyz_from_gamut = space.xyz_from_rgb;
        c.parameters.luminance = LuminancePolicy::photopic;
        c.parameters.strength.luminance = 1;
        RC_PRE(is_light(c));
        coverage(space.name);
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        coverage("kirk2011", c.parameters.model == Model::kirk2011);
        RC_ASSERT(std::abs(luminance(op, op(pixel)) / luminance(op, pixel.rgb) - 1) <= 1e-12);
      },
      all_working_spaces({{"kirk2011", 0.2}}));
}

TEST(OperatorProperties, the_mesopic_policy_lies_between_cones_and_rods) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.planes = Planes::rgb;
        Random random(bits(c.sample.rgb)[0] + 17);
        const WorkingSpace& space = any_space(random);
        c.parameters.xyz_from_rgb = space.xyz_from_rgb;
        c.parameters.xyz_from_gamut = space.xyz_from_rgb;
        c.parameters.luminance = LuminancePolicy::mesopic;
        c.parameters.strength.luminance = 1;
        c.parameters.strength.all = 1;
        RC_PRE(is_light(c));
        coverage(space.name);
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        const double cones = luminance(op, pixel.rgb);
        const double rods = rod_signal_from_rgb(op.constants(), pixel.rgb) / op.constants().rod_white;
        const double out = luminance(op, op(pixel));
        coverage("rods see less", rods < 0.9 * cones);
        coverage("rods see more", rods > 1.1 * cones);
        RC_ASSERT(out >= std::min(cones, rods) * (1 - 1e-12) && out <= std::max(cones, rods) * (1 + 1e-12));
      },
      all_working_spaces({{"rods see less", 0.1}, {"rods see more", 0.05}}));
}

TEST(OperatorProperties, a_grey_keeps_its_luminance) {
  for_all(cases({Regime::huge, Regime::subnormal}),
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

TEST(OperatorProperties, more_of_a_light_never_looks_darker_in_any_working_space_in_float_too) {
  double darker = 0;
  for_all(
      cases(no_light),
      [&](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.planes = Planes::rgb;
        Random random(bits(c.sample.rgb)[0]);
        const WorkingSpace& space = any_space(random);
        c.parameters.xyz_from_rgb = space.xyz_from_rgb;
        if (c.parameters.xyz_from_gamut && random.chance(0.5))
          c.parameters.xyz_from_gamut = space.xyz_from_rgb;
        c.parameters.strength.luminance = 1;
        if (c.parameters.luminance == LuminancePolicy::none)
          c.parameters.luminance = LuminancePolicy::mesopic;
        RC_PRE(is_light(c));
        Case more = c;
        const auto k = static_cast<float>(1 + random.log_uniform(1e-6, 10));
        for (auto& x : more.sample.rgb) x *= k;
        const AppearanceReference op(c.parameters);
        const auto seen = [&](const Case& x) { return luminance(op, op(x.sample.widened(x.planes))); };
        const AppearanceBatch batch(c.parameters);
        const auto seen_in_float = [&](const Case& x) {
          const auto out = applied(batch, x);
          return luminance(op, {out[0], out[1], out[2]});
        };
        coverage(space.name);
        coverage("mesopic",
                 c.parameters.luminance == LuminancePolicy::mesopic && c.parameters.weight == Weight::local);
        const double before = seen_in_float(c), after = seen_in_float(more);
        darker = std::max(darker, 1 - after / before);
        RC_ASSERT(seen(more) >= seen(c) * (1 - 3e-7));
        RC_ASSERT(after >= before * (1 - 4e-6));
      },
      all_working_spaces({{"mesopic", 0.2}}));
  std::printf("more of a light: darker in float by %.2g at most\n", darker);
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
        for (const double x : AppearanceReference(c.parameters)(c.sample.widened(c.planes)))
          RC_ASSERT(x >= 0);
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

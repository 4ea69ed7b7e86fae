// What holds for every pixel through the whole operator, by the reference and by the batch.
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <limits>
#include <thread>

#include "appearance/stages.h"
#include "properties/judge.h"
#include "properties/property.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

using Rgb = std::array<float, 3>;

std::array<std::uint32_t, 3> bits(const Rgb& v) { return std::bit_cast<std::array<std::uint32_t, 3>>(v); }
std::array<std::uint64_t, 3> bits(const Vec3<double>& v) { return std::bit_cast<std::array<std::uint64_t, 3>>(v); }

template <typename V>
double largest(const V& v) {
  double out = 0;
  for (const auto x : v) out = std::max(out, std::abs(static_cast<double>(x)));
  return out;
}

double distance(const Vec3<double>& a, const Vec3<double>& b) {
  return largest(Vec3<double>{a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

double luminance(const AppearanceReference& op, const Vec3<double>& rgb) {
  return dot(op.constants().luminance_from_rgb, rgb);
}

double local_luminance(const AppearanceReference& op, const Vec3<double>& rgb) {
  const auto& p = op.constants().parameters;
  return p.adaptation + (p.weight == Weight::local ? std::max(0.0, luminance(op, rgb) * p.white_luminance) : 0.0);
}

// A light: no component and no cone signal negative, and luminance not under 1/64 of the cone signals, white's being 1.
bool is_light(const Case& c) {
  const OperatorConstants constants(c.parameters);
  const Vec3<double> rgb = {c.sample.rgb[0], c.sample.rgb[1], c.sample.rgb[2]};
  const auto q = constants.lms_from_rgb * rgb;
  const double y = dot(constants.luminance_from_rgb, rgb);
  for (std::size_t i = 0; i < 3; ++i)
    if (rgb[i] < 0 || q[i] <= 0 || y < luminance_floor * q[i] / constants.cone_white[i]) return false;
  return largest(rgb) <= operable_limit && largest(rgb) > 1e-30;
}

const std::vector<Regime> no_light = {Regime::subnormal, Regime::tiny, Regime::huge};

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

TEST(OperatorProperties, strength_is_continuous) {
  // A step of the strengths moves a pixel by at most 300 times the step of its size: a shift is up to 30 times a dark
  // pixel's light, and its luminance follows.
  for_all(
      cases({Regime::huge, Regime::subnormal}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) return;
        if (!is_light(c)) return;
        c.planes = Planes::rgb;
        Case other = c;
        Random random(bits(c.sample.rgb)[1]);
        const double step = random.log_uniform(1e-9, 0.1);
        for (double* s : {&other.parameters.strength.all, &other.parameters.strength.shift,
                          &other.parameters.strength.luminance, &other.parameters.strength.chroma})
          *s = std::min(1.0, *s + step);
        const auto a = AppearanceReference(c.parameters)(c.sample.widened(c.planes));
        const auto b = AppearanceReference(other.parameters)(other.sample.widened(other.planes));
        coverage("light");
        RC_ASSERT(distance(a, b) <= 300 * step * std::max({largest(c.sample.rgb), largest(a), largest(b)}));
      },
      {{"light", 0.3}});
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

TEST(OperatorProperties, is_continuous_with_a_stated_slope) {
  // A step in RGB moves light by at most 500 times the step, wherever the step crosses: La = 5, .002, faces, clamps.
  // (At black the shift alone is 30 times; the weight, falling with Y, and the luminance add to it.)
  double steepest = 0;
  for_all(
      cases(no_light),
      [&](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) return;
        c.planes = Planes::rgb;
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        Random random(bits(c.sample.rgb)[1] + 3);
        const double step = largest(pixel.rgb) * random.log_uniform(1e-7, 0.3);
        ReferencePixel other = pixel;
        for (auto& x : other.rgb) x += step * random.uniform(-1, 1);
        const double moved = distance(op(pixel), op(other)), slope = moved / distance(pixel.rgb, other.rgb);
        steepest = std::max(steepest, slope);
        coverage("light");
        coverage("crossing 5", (local_luminance(op, pixel.rgb) < 5) != (local_luminance(op, other.rgb) < 5));
        coverage("crossing the gamut's face", *std::min_element(other.rgb.begin(), other.rgb.end()) < 0);
        RC_ASSERT(slope <= 500);
      },
      {{"light", 0.3}, {"crossing 5", 0.002}, {"crossing the gamut's face", 0.02}}, 40000);
  std::printf("steepest slope of light %.3g\n", steepest);
}

TEST(OperatorProperties, is_continuous_in_the_adaptation_luminance) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) return;
        c.planes = Planes::rgb;
        if (!is_light(c)) return;
        Random random(bits(c.sample.rgb)[0] + 5);
        const double edges[] = {5, 4.998, 0.002, 0.001, c.parameters.adaptation};
        const int edge = random.below(5);
        c.parameters.adaptation = edges[edge];
        Case other = c;
        const double step = random.log_uniform(1e-9, 1e-2);
        other.parameters.adaptation *= 1 - step;
        const auto pixel = c.sample.widened(c.planes);
        const auto a = AppearanceReference(c.parameters)(pixel), b = AppearanceReference(other.parameters)(pixel);
        coverage("at 5", edge == 0);
        coverage("at the scotopic end", edge == 2 || edge == 3);
        RC_ASSERT(distance(a, b) <= 100 * step * std::max(largest(a), largest(pixel.rgb)));
      },
      {{"at 5", 0.05}, {"at the scotopic end", 0.1}});
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

// A hundred pixels of all regimes under one setting.
struct Row {
  AppearanceParameters parameters;
  Planes planes;
  std::vector<Sample> samples;
};

Row draw_row(std::uint64_t seed, Coverage& coverage, int pixels) {
  Random random(seed);
  Row row{draw_parameters(random), draw_planes(random), {}};
  const OperatorConstants constants(row.parameters);
  for (int i = 0; i < pixels; ++i) {
    const auto regime = static_cast<Regime>(random.below(regime_count));
    coverage(name(regime));
    row.samples.push_back(draw(regime, constants, random));
  }
  return row;
}

std::vector<std::array<std::uint32_t, 3>> row_bits(Rows& rows) {
  std::vector<std::array<std::uint32_t, 3>> out;
  for (std::size_t i = 0; i < rows.r.size(); ++i) out.push_back(bits(rows.rgb(i)));
  return out;
}

const Shares regimes_in_rows = all_regimes();  // each at least once in 50 rows, in fact in nearly all

TEST(BatchProperties, order_and_grouping_of_pixels_do_not_matter) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        const Row row = draw_row(seed, coverage, 70);
        Random random(seed + 1);
        const Precision precision = random.chance(0.5) ? Precision::single : Precision::dual;
        const AppearanceBatch batch(row.parameters, precision);
        Rows whole(row.samples);
        batch.apply(whole.view(row.planes));
        const auto expected = row_bits(whole);
        std::vector<Sample> shuffled;
        std::vector<std::size_t> from(row.samples.size());
        for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
        for (std::size_t i = from.size() - 1; i > 0; --i) std::swap(from[i], from[random.bits() % (i + 1)]);
        for (const std::size_t i : from) shuffled.push_back(row.samples[i]);
        Rows parts(shuffled);
        for (std::size_t at = 0; at < shuffled.size();) {
          PixelRows view = parts.view(row.planes);
          const std::size_t count = std::min<std::size_t>(1 + random.bits() % 40, shuffled.size() - at);
          for (float** plane : {&view.r, &view.g, &view.b}) *plane += at;
          for (const float** plane : {&view.cone_l, &view.cone_m, &view.cone_s, &view.rod})
            if (*plane) *plane += at;
          view.count = count;
          batch.apply(view);
          at += count;
        }
        const auto got = row_bits(parts);
        for (std::size_t i = 0; i < from.size(); ++i) RC_ASSERT(got[i] == expected[from[i]]);
      },
      regimes_in_rows);
}

TEST(BatchProperties, every_simd_target_gives_the_same_bits) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        const Row row = draw_row(seed, coverage, 37);
        const Precision precision = seed % 2 ? Precision::single : Precision::dual;
        const AppearanceBatch batch(row.parameters, precision);
        std::vector<std::array<std::uint32_t, 3>> expected;
        for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
          hwy::SetSupportedTargetsForTest(target);
          Rows rows(row.samples);
          batch.apply(rows.view(row.planes));
          const auto got = row_bits(rows);
          if (expected.empty()) expected = got;
          else coverage("a second target");
          if (got != expected) hwy::SetSupportedTargetsForTest(0);
          RC_ASSERT(got == expected);
        }
        hwy::SetSupportedTargetsForTest(0);
      },
      regimes_in_rows);
}

TEST(BatchProperties, threads_do_not_matter) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        const Row row = draw_row(seed, coverage, 4 * 64);
        const AppearanceBatch batch(row.parameters);
        Rows one(row.samples), many(row.samples);
        batch.apply(one.view(row.planes));
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 4; ++t)
          threads.emplace_back([&, t] {
            PixelRows view = many.view(row.planes);
            for (float** plane : {&view.r, &view.g, &view.b}) *plane += 64 * t;
            for (const float** plane : {&view.cone_l, &view.cone_m, &view.cone_s, &view.rod})
              if (*plane) *plane += 64 * t;
            view.count = 64;
            batch.apply(view);
          });
        for (auto& thread : threads) thread.join();
        RC_ASSERT(row_bits(many) == row_bits(one));
      },
      regimes_in_rows, 500);
}

}  // namespace
}  // namespace scotopic::test

// The display stage on rows, against the same formula in long double, written apart from the code.
#include "batch/display_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "support/primaries.h"
#include "support/simd_targets.h"

namespace scotopic {
namespace {

using Exact = long double;

// The EV is a parameter of the stage, not part of what is judged here: thresholds_test has it.
Vec3<Exact> shown(const NightDisplayParameters& p, const Vec3<float>& rgb) {
  const Exact stops = p.strength * static_cast<Exact>(visibility_stops(p.adaptation, p.rule, p.viewing));
  const Exact scale =
      p.viewing / static_cast<Exact>(p.adaptation) * std::exp2(stops) * p.white_luminance / p.peak;
  const Matrix3<Exact> to = (inverse(p.xyz_from_display) * p.xyz_from_rgb).to<Exact>(), back = inverse(to);
  Vec3<Exact> x = to * Vec3<Exact>{rgb[0], rgb[1], rgb[2]};
  for (Exact& c : x) c = std::max(Exact(0), c * scale);
  const Exact v = std::max({x[0], x[1], x[2]});
  if (p.shoulder == Shoulder::bend && v > 0.5L) {
    const Exact s = 0.5L + 0.5L * (1 - std::exp(-(v - 0.5L) / 0.5L));
    const Exact over = std::max(Exact(0), v - 1), w = over / (over + 32);
    for (Exact& c : x) c = c * s / v * (1 - w) + s * w;
  }
  return back * x;
}

struct Planes {
  std::vector<float> r, g, b;
  PixelRows rows() { return {r.data(), g.data(), b.data(), nullptr, nullptr, nullptr, nullptr, r.size()}; }
};

// Light from a millionth of the peak to ten million peaks; some below 0, as other gamuts' colours are.
Planes drawn_for_display(std::size_t count, const NightDisplayParameters& p, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> decades(-6, 7), share(-0.05, 1);
  Planes out;
  for (std::size_t i = 0; i < count; ++i) {
    const double level = std::pow(10.0, decades(random)) / display_scale(p);
    out.r.push_back(static_cast<float>(level * share(random)));
    out.g.push_back(static_cast<float>(level * share(random)));
    out.b.push_back(static_cast<float>(level * share(random)));
  }
  return out;
}

NightDisplayParameters shown_at(double la, double peak = 100, bool other_primaries = false) {
  NightDisplayParameters p;
  p.adaptation = la;
  p.white_luminance = la / 0.18;
  p.peak = peak;
  p.xyz_from_rgb = other_primaries ? test::rec2020 : test::rec709;
  p.xyz_from_display = test::rec709;
  return p;
}

class DisplayBatchTest : public testing::TestWithParam<Precision> {};

TEST_P(DisplayBatchTest, is_the_formula_to_a_few_ulp_of_what_is_shown) {
  const bool single = GetParam() == Precision::single;
  double worst = 0;
  for (const double la : {0.001, 0.01, 0.1, 1.0, 10.0})
    for (const double peak : {100.0, 1000.0})
      for (const bool other : {false, true}) {
        const NightDisplayParameters p = shown_at(la, peak, other);
        Planes planes = drawn_for_display(20000, p, 7), in = planes;
        DisplayBatch(p, GetParam()).apply(planes.rows());
        for (std::size_t i = 0; i < in.r.size(); ++i) {
          const Vec3<float> before = {in.r[i], in.g[i], in.b[i]};
          const Vec3<Exact> e = shown(p, before);
          const Exact largest = std::max({std::abs(e[0]), std::abs(e[1]), std::abs(e[2]), Exact(1e-30)});
          const float got[3] = {planes.r[i], planes.g[i], planes.b[i]};
          for (std::size_t c = 0; c < 3; ++c)
            worst = std::max(worst, static_cast<double>(std::abs(got[c] - e[c]) / largest));
        }
      }
  std::printf("display, %s: worst error %.2g of the largest component\n", single ? "float" : "double inside",
              worst);
  EXPECT_LE(worst, single ? 1.5e-6 : 6.5e-8);
}

INSTANTIATE_TEST_SUITE_P(Both, DisplayBatchTest, testing::Values(Precision::single, Precision::dual));

TEST(DisplayBatch, every_target_and_every_length_gives_the_same_bits) {
  const NightDisplayParameters p = shown_at(0.05, 100, true);
  const DisplayBatch batch(p);
  Planes all = drawn_for_display(4099, p, 3);
  const Planes in = all;
  batch.apply(all.rows());
  test::on_every_target([&](const char* target) {
    for (const std::size_t step : {std::size_t{1}, std::size_t{7}, std::size_t{64}, in.r.size()}) {
      Planes pieces = in;
      for (std::size_t at = 0; at < in.r.size(); at += step)
        batch.apply({pieces.r.data() + at, pieces.g.data() + at, pieces.b.data() + at, nullptr, nullptr,
                     nullptr, nullptr, std::min(step, in.r.size() - at)});
      EXPECT_EQ(pieces.r, all.r) << target << step;
      EXPECT_EQ(pieces.b, all.b) << target << step;
    }
  });
}

TEST(DisplayBatch, what_needs_neither_scale_nor_shoulder_keeps_its_bits) {
  NightDisplayParameters p = shown_at(100);
  p.shoulder = Shoulder::clip;
  ASSERT_EQ(display_scale(p), 1);
  const DisplayBatch batch(p);
  EXPECT_TRUE(batch.keeps_range());
  Planes planes;
  for (int code = 0; code < 65536; ++code)
    for (std::vector<float>* plane : {&planes.r, &planes.g, &planes.b})
      plane->push_back(static_cast<float>(code) / 65535.0f);
  const Planes in = planes;
  std::vector<std::uint8_t> touched(in.r.size());
  batch.apply(planes.rows(), touched.data());
  EXPECT_EQ(planes.r, in.r);
  EXPECT_EQ(std::count(touched.begin(), touched.end(), 0), std::ssize(touched));
}

TEST(DisplayBatch, pixels_that_are_not_finite_pass_and_say_so) {
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  Planes planes{{inf, nan, 1, 1}, {1, 1, -inf, 1}, {1, 1, 1, 1}};
  std::vector<std::uint8_t> touched(4);
  DisplayBatch(shown_at(0.01)).apply(planes.rows(), touched.data());
  EXPECT_EQ(touched, (std::vector<std::uint8_t>{0, 0, 0, 1}));
  EXPECT_EQ(planes.r[0], inf);
  EXPECT_TRUE(std::isnan(planes.r[1]));
  EXPECT_EQ(planes.g[0], 1);
}

TEST(NightDisplay, goes_up_with_light_and_never_over_the_peak) {
  for (const double la : {0.001, 0.1, 3.0}) {
    const NightDisplayParameters p = shown_at(la);
    Vec3<double> before{};
    for (double stop = -20; stop < 30; stop += 1.0 / 64) {
      const double level = std::exp2(stop) / display_scale(p);
      const Vec3<double> out = night_display(p, {level, 0.3 * level, 0.01 * level});
      EXPECT_GE(out[0], before[0] - 4e-16) << stop;
      EXPECT_LE(out[0], 1 + 4e-16);
      EXPECT_LE(out[0] - before[0], 0.012) << "a jump at " << stop;
      before = out;
    }
  }
}

// Display code of sRGB, 0 to 255.
double code(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

TEST(NightDisplay, a_red_tail_lamp_stays_red_and_a_street_lamp_gets_a_white_core) {
  for (const double la : {0.1, 0.01}) {
    const NightDisplayParameters p = shown_at(la);
    const Vec3<double> red = night_display(p, {60, 2, 0.5});
    EXPECT_GE(code(red[0]), 240) << la;
    EXPECT_LE(code(red[1]), 150) << la;
    EXPECT_LE(code(red[2]), 150) << la;
    const Vec3<double> lamp = night_display(p, {6000, 3000, 800});
    EXPECT_GE(code(lamp[2]), 240) << la;
  }
}

}  // namespace
}  // namespace scotopic

#include "batch/batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "stages/reference.h"
#include "support/primaries.h"
#include "support/simd_targets.h"

namespace scotopic {
namespace {

struct Image {
  std::vector<float> r, g, b;
  explicit Image(std::size_t n) : r(n), g(n), b(n) {}
  PixelRows rows() { return {r.data(), g.data(), b.data(), nullptr, nullptr, nullptr, nullptr, r.size()}; }
  bool operator==(const Image& o) const {
    const auto same = [](const std::vector<float>& x, const std::vector<float>& y) {
      return std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
    };
    return same(r, o.r) && same(g, o.g) && same(b, o.b);
  }
};

// Values over 14 decades: inside, on and outside the gamut, some negative, some single-channel.
Image many_colours(std::size_t n, unsigned seed, double low, double high) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  Image image(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double level = low * std::pow(high / low, uniform(random));
    const auto channel = [&]() -> float {
      const double kind = uniform(random);
      if (kind < 0.15) return 0;
      if (kind < 0.25) return float(-0.1 * level * uniform(random));
      return float(level * std::pow(uniform(random), 3));
    };
    image.r[i] = channel();
    image.g[i] = channel();
    image.b[i] = channel();
  }
  return image;
}

AppearanceParameters at(double adaptation, double white) {
  AppearanceParameters p;
  p.adaptation = adaptation;
  p.white_luminance = white;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return p;
}

struct Worst {
  double error = 0;
  Vec3<double> in{}, got{}, expected{};
};

// Error of every pixel relative to its largest component, in or out.
Worst against_reference(const AppearanceParameters& p, const Image& in, Precision precision) {
  Image out = in;
  AppearanceBatch(p, precision).apply(out.rows());
  const AppearanceReference reference(p);
  Worst worst;
  for (std::size_t i = 0; i < in.r.size(); ++i) {
    const Vec3<double> rgb = {in.r[i], in.g[i], in.b[i]};
    const Vec3<double> expected = reference({rgb});
    const Vec3<double> got = {out.r[i], out.g[i], out.b[i]};
    double size = 0, error = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      size = std::max({size, std::abs(expected[k]), std::abs(rgb[k])});
      error = std::max(error, std::abs(got[k] - expected[k]));
    }
    if (size > 0) error /= size;
    if (!(error <= worst.error)) worst = {error, rgb, got, expected};
  }
  return worst;
}

void print(const char* what, double la, const Worst& w) {
  std::printf(
      "%s La %-8.3g worst %.3g at (%.9g, %.9g, %.9g): got (%.9g, %.9g, %.9g), expected (%.9g, %.9g, %.9g)\n",
      what, la, w.error, w.in[0], w.in[1], w.in[2], w.got[0], w.got[1], w.got[2], w.expected[0],
      w.expected[1], w.expected[2]);
}

class BatchAgainstReference : public testing::TestWithParam<double> {};

TEST_P(BatchAgainstReference, float_is_within_2e_6_of_the_pixel_s_largest_component) {
  const double la = GetParam();
  for (const Model model : {Model::filament2021, Model::kirk2011, Model::cao2008}) {
    auto p = at(la, 1.0);
    p.model = model;
    const Worst worst = against_reference(p, many_colours(20000, 7, 1e-6, 1e6), Precision::single);
    print(model == Model::cao2008    ? "cao2008"
          : model == Model::kirk2011 ? "kirk2011"
                                     : "filament2021",
          la, worst);
    EXPECT_LE(worst.error, 2e-6);
  }
}

TEST_P(BatchAgainstReference, double_inside_is_within_an_ulp_of_float) {
  const double la = GetParam();
  const Worst worst = against_reference(at(la, 1.0), many_colours(20000, 8, 1e-6, 1e6), Precision::dual);
  print("double inside", la, worst);
  EXPECT_LE(worst.error, 6.1e-8);
}

INSTANTIATE_TEST_SUITE_P(Adaptations, BatchAgainstReference,
                         testing::Values(1e-6, 1e-4, 0.001, 0.01, 0.1, 1.0, 4.9));

TEST(Batch, options_agree_with_the_reference) {
  const Image in = many_colours(5000, 9, 1e-4, 100);
  const auto check = [&](const char* what, const AppearanceParameters& p) {
    const Worst worst = against_reference(p, in, Precision::single);
    print(what, p.adaptation, worst);
    EXPECT_LE(worst.error, 3e-6) << what;
  };
  auto p = at(0.05, 0.3);
  p.weight = Weight::global;
  check("global weight", p);
  p = at(0.05, 0.3), p.luminance = LuminancePolicy::photopic;
  check("photopic", p);
  p = at(0.05, 0.3), p.luminance = LuminancePolicy::none;
  check("no luminance", p);
  p = at(0.05, 0.3), p.rods = RodEstimate::quadratic;
  check("quadratic", p);
  p = at(0.05, 0.3), p.sp_ratio = 0.645;
  check("sodium", p);
  p = at(0.05, 0.3), p.strength = {0.7, 0.5, 0.8, 0.4};
  check("strengths", p);
  p = at(0.05, 0.3), p.xyz_from_gamut = test::rec2020;
  check("rec2020 gamut", p);
  p = at(0.05, 0.3), p.xyz_from_gamut.reset();
  check("no gamut", p);
  p = at(0.05, 0.3), p.model = Model::safko2019;
  check("safko2019", p);
  p = at(0.05, 0.3), p.model = Model::cao2008, p.weight = Weight::global, p.rods = RodEstimate::quadratic;
  check("cao2008", p);
}

TEST(Batch, every_simd_target_gives_the_same_bits) {
  const Image in = many_colours(4099, 10, 1e-6, 1e4);
  for (const Precision precision : {Precision::single, Precision::dual}) {
    const AppearanceBatch batch(at(0.01, 0.05), precision);
    Image best = in;
    batch.apply(best.rows());
    int targets = 0;
    test::on_every_target([&](const char* target) {
      Image out = in;
      batch.apply(out.rows());
      EXPECT_TRUE(out == best) << target;
      ++targets;
    });
    std::printf("%d targets compared\n", targets);
  }
}

TEST(Batch, grouping_pixels_differently_gives_the_same_bits) {
  const Image in = many_colours(3000, 11, 1e-6, 1e4);
  for (const Precision precision : {Precision::single, Precision::dual}) {
    const AppearanceBatch batch(at(0.01, 0.05), precision);
    Image whole = in;
    batch.apply(whole.rows());
    for (const std::size_t piece : {1u, 3u, 16u, 17u, 333u, 1501u}) {
      Image out = in;
      for (std::size_t i = 0; i < 3000; i += piece) {
        PixelRows rows = out.rows();
        rows.r += i, rows.g += i, rows.b += i;
        rows.count = std::min<std::size_t>(piece, 3000 - i);
        batch.apply(rows);
      }
      EXPECT_TRUE(out == whole) << piece;
    }
  }
}

TEST(Batch, wherever_planes_lie_in_memory_the_bits_are_the_same) {
  // Long rows are taken from the first aligned vector on, where the planes have one in common.
  constexpr std::size_t count = 2500, room = count + 64;
  const Image in = many_colours(count, 12, 1e-6, 1e4);
  for (const Precision precision : {Precision::single, Precision::dual}) {
    const AppearanceBatch batch(at(0.01, 0.05), precision);
    Image whole = in;
    batch.apply(whole.rows());
    for (std::size_t shift = 0; shift < 17; ++shift)
      for (const std::size_t apart : {0u, 1u, 4u}) {
        Image out(room);
        std::copy(in.r.begin(), in.r.end(), out.r.begin() + static_cast<std::ptrdiff_t>(shift));
        std::copy(in.g.begin(), in.g.end(), out.g.begin() + static_cast<std::ptrdiff_t>(shift + apart));
        std::copy(in.b.begin(), in.b.end(), out.b.begin() + static_cast<std::ptrdiff_t>(shift + 2 * apart));
        PixelRows rows;
        rows.r = &out.r[shift], rows.g = &out.g[shift + apart], rows.b = &out.b[shift + 2 * apart];
        rows.count = count;
        batch.apply(rows);
        EXPECT_EQ(std::memcmp(rows.r, whole.r.data(), count * sizeof(float)), 0) << shift << ' ' << apart;
        EXPECT_EQ(std::memcmp(rows.g, whole.g.data(), count * sizeof(float)), 0) << shift << ' ' << apart;
        EXPECT_EQ(std::memcmp(rows.b, whole.b.data(), count * sizeof(float)), 0) << shift << ' ' << apart;
      }
  }
}

TEST(Batch, code_compiled_for_some_stages_and_code_that_asks_give_the_same_bits) {
  const Image in = many_colours(3001, 13, 1e-6, 1e4);
  auto planned = at(0.02, 0.1);
  const struct {
    double shift, luminance, chroma;
    LuminancePolicy policy;
  } rows[] = {{1, 1, 1, LuminancePolicy::mesopic},
              {1, 1, 1, LuminancePolicy::photopic},
              {1, 0, 0, LuminancePolicy::mesopic},
              {0, 0, 1, LuminancePolicy::mesopic}};
  for (const auto& row : rows) {
    planned.strength = {1, row.shift, row.luminance, row.chroma};
    planned.luminance = row.policy;
    const AppearanceBatch batch(planned);
    Image compiled = in, alone = in;
    batch.apply(compiled.rows());
    // A pixel by itself, as the last of a row, goes by the code that asks.
    for (std::size_t i = 0; i < in.r.size(); ++i) {
      PixelRows one;
      one.r = &alone.r[i], one.g = &alone.g[i], one.b = &alone.b[i], one.count = 1;
      batch.apply(one);
    }
    EXPECT_TRUE(compiled == alone) << row.shift << row.luminance << row.chroma;
    EXPECT_FALSE(compiled == in);
  }
}

TEST(Batch, photopic_pixels_keep_their_bits_and_say_so) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const float nan = std::bit_cast<float>(0x7fa12345u);  // signalling, with a payload
  const float odd[] = {0.f, -0.f, 1.f, -1.f, inf, -inf, nan, 1e-45f, -1e-40f, 3.4e38f, -3.4e38f};
  Image in(11 * 11 * 11);
  std::size_t n = 0;
  for (float r : odd)
    for (float g : odd)
      for (float b : odd) in.r[n] = r, in.g[n] = g, in.b[n] = b, ++n;
  for (const double la : {5.0, 10.0, 1e5}) {
    Image out = in;
    std::vector<std::uint8_t> touched(n, 9);
    AppearanceBatch(at(la, la / 0.18)).apply(out.rows(), touched.data());
    EXPECT_TRUE(out == in) << la;
    for (auto t : touched) ASSERT_EQ(t, 0);
  }
  // In the dark the same holds for every pixel that is not finite, and finite pixels stay finite.
  Image out = in;
  std::vector<std::uint8_t> touched(n, 9);
  AppearanceBatch(at(0.01, 0.05)).apply(out.rows(), touched.data());
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isfinite(in.r[i]) && std::isfinite(in.g[i]) && std::isfinite(in.b[i])) {
      EXPECT_TRUE(std::isfinite(out.r[i]) && std::isfinite(out.g[i]) && std::isfinite(out.b[i]))
          << in.r[i] << ' ' << in.g[i] << ' ' << in.b[i] << " -> " << out.r[i] << ' ' << out.g[i] << ' '
          << out.b[i];
    } else {
      EXPECT_EQ(touched[i], 0);
      EXPECT_EQ(std::bit_cast<std::uint32_t>(out.r[i]), std::bit_cast<std::uint32_t>(in.r[i]));
    }
  }
}

TEST(Batch, receptor_planes_take_the_place_of_estimates) {
  auto p = at(0.02, 1.0);
  const AppearanceReference reference(p);
  const Vec3<double> rgb = {0.02, 0.03, 0.01}, cones = {0.012, 0.009, 0.004};
  float r = 0.02f, g = 0.03f, b = 0.01f;
  const float l = 0.012f, m = 0.009f, s = 0.004f, rod = 0.02f;
  AppearanceBatch(p).apply({&r, &g, &b, &l, &m, &s, &rod, 1});
  const Vec3<double> expected = reference({rgb, cones, 0.02});
  EXPECT_NEAR(r, expected[0], 1e-8);
  EXPECT_NEAR(g, expected[1], 1e-8);
  EXPECT_NEAR(b, expected[2], 1e-8);
  const Vec3<double> estimated = reference({rgb});
  EXPECT_GT(std::abs(estimated[2] - expected[2]), 1e-4);
}

}  // namespace
}  // namespace scotopic

// The noise stage on rows, against the same formula in long double, written apart from the code.
#include "batch/noise_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "adaptation/mesopic.h"
#include "support/primaries.h"
#include "support/simd_targets.h"

namespace scotopic {
namespace {

using Exact = long double;

RodNoiseParameters noise_at(double la, double ppd = 40) {
  RodNoiseParameters p;
  p.eye.adaptation = la;
  p.eye.white_luminance = la / 0.18;
  p.eye.xyz_from_rgb = test::rec709;
  p.pixels_per_degree = ppd;
  return p;
}

struct NoisyPlanes {
  std::vector<float> r, g, b, rod, local;
  std::vector<double> n;
  PixelRows rows() { return {r.data(), g.data(), b.data(), nullptr, nullptr, nullptr, nullptr, r.size()}; }
  ReceivedRow received() { return {rod.data(), local.data()}; }
};

// Light from a thousandth of La to a lamp's; some below 0, as other gamuts' colours are. n within its bounds.
NoisyPlanes drawn_with_noise(const RodNoiseParameters& p, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> decades(-3, 4), share(-0.05, 1), field(-4.9, 4.9);
  NoisyPlanes out;
  for (std::size_t i = 0; i < count; ++i) {
    const double level = std::pow(10.0, decades(random));
    for (std::vector<float>* plane : {&out.r, &out.g, &out.b})
      plane->push_back(static_cast<float>(level * share(random)));
    out.n.push_back(field(random));
  }
  out.rod.resize(count);
  out.local.resize(count);
  NoiseBatch(p).receive(out.rows(), out.received());
  return out;
}

struct Judged {
  Vec3<Exact> rgb;
  Exact v, bound;  // variance over mean times quantum; what errors are relative to
};

// What n makes of a pixel as rod_noise.h writes it, with S' by its own square.
Judged judged(const RodNoiseParameters& p, const NoisyPlanes& in, std::size_t i) {
  const RodPool pool = rod_pool(p);
  const Exact white = OperatorConstants(p.eye).rod_white, unit = p.eye.white_luminance;
  const Exact s = 2.4648L * std::max(0.0f, in.rod[i]) / white * unit, mu = s + pool.dark;
  const Exact seen = std::max<Exact>(s, 2.4648L * p.eye.adaptation) + pool.dark;
  const Exact nu = p.hidden_fraction;
  const Exact v = mu * pool.quantum - nu * nu * seen * seen;
  const Vec3<Exact> rgb = {in.r[i], in.g[i], in.b[i]};
  const Exact m = mesopic_coefficient(in.local[i]), c = 683.0L / 1699;
  Exact change = 0;
  if (v > 0 && m < 1) {
    const Exact half = std::min(v, 2 * mu * mu) / 2, b = half / (mu + std::sqrt(mu * mu - half));
    const Exact root = std::sqrt(mu - b) + std::sqrt(b) * in.n[i];
    const Exact noisy = std::max<Exact>(0, root * root - pool.dark);
    change = (1 - m) * c * (noisy - s) / (m + (1 - m) * 2.4648L * c) / unit;
  }
  const auto& row = p.eye.xyz_from_rgb[1];
  const Exact y = row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2];
  Vec3<Exact> out = rgb;
  for (Exact& x : out) {
    if (change >= 0)
      x += change;
    else if (y > 0)
      x *= std::max<Exact>(0, 1 + change / y);
  }
  const Exact largest = std::max({std::abs(rgb[0]), std::abs(rgb[1]), std::abs(rgb[2]), std::abs(change)});
  return {out, v / (mu * pool.quantum), std::max(largest, mu / unit)};
}

class NoiseBatchTest : public testing::TestWithParam<Precision> {};

TEST_P(NoiseBatchTest, is_the_formula) {
  const bool single = GetParam() == Precision::single;
  double worst = 0, cancelled = 0;
  std::size_t changed = 0;
  for (const double la : {1e-5, 1e-4, 1e-3, 2.5e-3}) {
    const RodNoiseParameters p = noise_at(la);
    const NoisyPlanes in = drawn_with_noise(p, 20000, 5);
    NoisyPlanes out = in;
    NoiseBatch(p, GetParam()).apply(out.rows(), out.received(), out.n.data());
    for (std::size_t i = 0; i < in.r.size(); ++i) {
      const Judged e = judged(p, in, i);
      const float got[3] = {out.r[i], out.g[i], out.b[i]};
      const Vec3<float> before = {in.r[i], in.g[i], in.b[i]};
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = static_cast<double>(std::abs(got[c] - e.rgb[c]) / e.bound);
        double& least = std::abs(e.v) < 1e-3L ? cancelled : worst;
        least = std::max(least, error);
        changed += got[c] != before[c];
      }
    }
  }
  std::printf("noise, %s: worst error %.2g; %.2g where v cancels\n", single ? "float" : "double inside",
              worst, cancelled);
  EXPECT_GT(changed, 50000u);
  EXPECT_LE(worst, single ? 2e-5 : 2e-7);
  EXPECT_LE(cancelled, single ? 3e-5 : 2e-7);
}

INSTANTIATE_TEST_SUITE_P(Both, NoiseBatchTest, testing::Values(Precision::single, Precision::dual));

TEST(NoiseBatch, every_target_and_every_length_gives_the_same_bits) {
  const RodNoiseParameters p = noise_at(3e-4);
  for (const Precision precision : {Precision::single, Precision::dual}) {
    const NoiseBatch batch(p, precision);
    const NoisyPlanes in = drawn_with_noise(p, 1031, 3);
    NoisyPlanes all = in;
    std::vector<std::uint8_t> touched(in.r.size());
    batch.receive(all.rows(), all.received());
    batch.apply(all.rows(), all.received(), all.n.data(), touched.data());
    for (std::size_t i = 0; i < in.r.size(); ++i)
      EXPECT_EQ(touched[i] != 0, all.r[i] != in.r[i] || all.g[i] != in.g[i] || all.b[i] != in.b[i]);
    test::on_every_target([&](const char* target) {
      for (const std::size_t step : {std::size_t{1}, std::size_t{7}, std::size_t{300}, in.r.size()}) {
        NoisyPlanes pieces = in;
        for (std::size_t i = 0; i < in.r.size(); i += step) {
          const std::size_t count = std::min(step, in.r.size() - i);
          const PixelRows rows = {pieces.r.data() + i,
                                  pieces.g.data() + i,
                                  pieces.b.data() + i,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  nullptr,
                                  count};
          const ReceivedRow received = {pieces.rod.data() + i, pieces.local.data() + i};
          batch.receive(rows, received);
          batch.apply(rows, received, pieces.n.data() + i);
        }
        EXPECT_EQ(pieces.rod, all.rod) << target << step;
        EXPECT_EQ(pieces.local, all.local) << target << step;
        EXPECT_EQ(pieces.r, all.r) << target << step;
        EXPECT_EQ(pieces.g, all.g) << target << step;
        EXPECT_EQ(pieces.b, all.b) << target << step;
      }
    });
  }
}

TEST(NoiseBatch, receives_rods_and_local_luminance) {
  RodNoiseParameters p = noise_at(1e-3);
  p.rod_adaptation = 0.05;
  NoisyPlanes planes = drawn_with_noise(p, 100, 9);
  for (std::size_t i = 0; i < 100; ++i) {
    const Vec3<double> xyz = test::rec709 * Vec3<double>{planes.r[i], planes.g[i], planes.b[i]};
    const double rod = rod_signal_per_scotopic_luminance() *
                       scotopic_luminance_from_xyz(xyz, RodEstimate::linear, sp_ratio_d65);
    EXPECT_NEAR(planes.rod[i], std::max(0.0, rod), 1e-6 * (std::abs(rod) + std::abs(planes.r[i])));
    EXPECT_NEAR(planes.local[i], 0.05 + std::max(0.0, xyz[1]) * p.eye.white_luminance,
                1e-6 * planes.local[i]);
  }
  // Given rods are taken as they are; without local weight Lloc is the adaptation.
  p.eye.weight = Weight::global;
  const std::vector<float> given(100, 0.3f);
  PixelRows rows = planes.rows();
  rows.rod = given.data();
  NoiseBatch(p).receive(rows, planes.received());
  EXPECT_EQ(planes.rod, given);
  EXPECT_EQ(planes.local, std::vector<float>(100, 0.05f));
}

TEST(NoiseBatch, pixels_that_are_not_finite_pass_and_say_so) {
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const RodNoiseParameters p = noise_at(1e-4);
  NoisyPlanes planes{{inf, nan, 1, 1, 0x1p121f},
                     {1, 1, -inf, 1, 1},
                     {1, 1, 1, 1, 1},
                     {0, 0, 0, 0, 0},
                     {0, 0, 0, 0, 0},
                     {2, 2, 2, 2, 2}};
  std::vector<std::uint8_t> touched(5);
  const NoiseBatch batch(p);
  batch.receive(planes.rows(), planes.received());
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(planes.local[i] == inf, i != 3) << i;
  batch.apply(planes.rows(), planes.received(), planes.n.data(), touched.data());
  EXPECT_EQ(touched, (std::vector<std::uint8_t>{0, 0, 0, 1, 0}));
  EXPECT_EQ(planes.r[0], inf);
  EXPECT_TRUE(std::isnan(planes.r[1]));
  EXPECT_EQ(planes.g[0], 1);
}

TEST(NoiseBatch, where_noise_is_not_called_for_no_bit_changes) {
  const RodNoiseParameters p = noise_at(0.003);
  ASSERT_FALSE(rod_noise_need(p).needed);
  for (const Precision precision : {Precision::single, Precision::dual}) {
    NoisyPlanes planes = drawn_with_noise(p, 5000, 1);
    const NoisyPlanes in = planes;
    NoiseBatch(p, precision).apply(planes.rows(), planes.received(), planes.n.data());
    EXPECT_EQ(planes.r, in.r);
    EXPECT_EQ(planes.g, in.g);
    EXPECT_EQ(planes.b, in.b);
  }
}

}  // namespace
}  // namespace scotopic

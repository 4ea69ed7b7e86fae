// The random field: published Philox words, values printed to their last digit, and what a field must be.
#include "stages/noise/field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "stages/noise/philox.h"
#include "stages/noise/pitch.h"

namespace scotopic::noise {
namespace {

using test::time_pitch;

TEST(Philox, gives_the_words_of_random123) {
  // Known-answer vectors of Random123 1.09, kat_vectors, philox4x32 10.
  constexpr std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxWords{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}),
            (PhiloxWords{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxWords{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(NoiseField, lattice_values_are_these_doubles) {
  EXPECT_EQ(lattice_value({1, 1, 0}, 0, 0, 0), 1.0751901230213623);
  EXPECT_EQ(lattice_value({1, 1, 1}, -1, 2, 3), -0.3111187542106998);
  // Seeds beyond 32 bits, and streams, are others; places go round after 2^32.
  EXPECT_NE(lattice_value({1, 1, 1}, 0, 0, 0), lattice_value({1, 1, (std::uint64_t{1} << 32) + 1}, 0, 0, 0));
  EXPECT_NE(lattice_value({1, 1, 1, 0}, 0, 0, 0), lattice_value({1, 1, 1, 1}, 0, 0, 0));
  EXPECT_EQ(lattice_value({1, 1, 1}, -1, 0, 0), lattice_value({1, 1, 1}, (std::int64_t{1} << 32) - 1, 0, 0));
}

TEST(NoiseField, values_are_those_computed_apart) {
  const Lattice lattice{0.2, time_pitch, 7};
  const struct {
    double x, y, n;
  } rows[] = {{1.025, 0.5, 1.86791181},
              {2.3, 0.5, -2.00243432},
              {1.025, -3.25, 1.06466448},
              {2.3, -3.25, -2.07377695}};
  for (const auto& row : rows)
    EXPECT_NEAR(field_at(lattice, row.x, row.y, 0.35), row.n, 5.1e-9) << row.x << " " << row.y;
}

TEST(NoiseField, weights_are_a_cubic_b_spline_of_unit_power) {
  for (const double at : {-7.3, -1.0, 0.0, 0.25, 0.5, 0.999, 12345.678}) {
    const Taps taps = spline_taps(at);
    EXPECT_EQ(taps.first, static_cast<std::int64_t>(std::floor(at)) - 1);
    double squares = 0, sum = 0, moment = 0;
    for (int i = 0; i < 4; ++i) {
      squares += taps.weight[i] * taps.weight[i];
      sum += taps.weight[i];
      moment += taps.weight[i] * static_cast<double>(taps.first + i);
    }
    EXPECT_NEAR(squares, 1, 4e-16);
    EXPECT_NEAR(moment / sum, at, 1e-12 * std::max(1.0, std::abs(at)));  // reproduces straight lines
  }
}

// Mean, variance and excess kurtosis of n at 100^3 places that share no lattice point: tolerances are 5
// standard errors.
TEST(NoiseField, has_mean_0_and_variance_1) {
  const Lattice lattice{0.2, time_pitch, 42};
  double sum = 0, squares = 0, fourth = 0, largest = 0;
  constexpr int side = 100;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) {
        const auto at = [](int n, double pitch) { return pitch * (4.37 * n + 0.11); };
        const double n = field_at(lattice, at(i, 0.2), at(j, 0.2), at(k, time_pitch));
        sum += n;
        squares += n * n;
        fourth += n * n * n * n;
        largest = std::max(largest, std::abs(n));
      }
  constexpr double count = 1.0 * side * side * side;
  const double variance = squares / count;
  const double kurtosis = fourth / count / (variance * variance) - 3;
  std::printf("field: mean %.5f, variance %.5f, excess kurtosis %.4f, largest %.2f\n", sum / count, variance,
              kurtosis, largest);
  EXPECT_NEAR(sum / count, 0, 0.005);
  EXPECT_NEAR(variance, 1, 0.007);
  EXPECT_NEAR(kurtosis, -0.09, 0.03);
  EXPECT_LE(largest, 5.5);
}

double correlation(const Lattice& lattice, double dx, double dt) {
  double products = 0, squares = 0;
  for (int i = 0; i < 300; ++i)
    for (int j = 0; j < 300; ++j) {
      const double x = 0.9137 * i, y = 0.8731 * j, t = 0.0173 * (i + 2 * j);
      const double a = field_at(lattice, x, y, t), b = field_at(lattice, x + dx, y, t + dt);
      products += a * b;
      squares += (a * a + b * b) / 2;
    }
  return products / squares;
}

TEST(NoiseField, goes_with_time_as_the_pool_forgets) {
  // Septic B-spline of the lag over h_t, but for the weights' norms (0.587 and 0.108), averaged in double
  // apart.
  const Lattice lattice{0.2, time_pitch, 3};
  EXPECT_NEAR(correlation(lattice, 0, 1.0 / 24), 0.588, 0.02);
  EXPECT_NEAR(correlation(lattice, 0, 2.0 / 24), 0.108, 0.02);
  EXPECT_NEAR(correlation(lattice, 0, 0.3), 0, 0.02);
  EXPECT_NEAR(correlation(lattice, 0.2 * 0.8692, 0), 0.588, 0.02);  // and with angle alike
}

TEST(NoiseField, a_changing_pitch_neither_jumps_nor_changes_the_variance) {
  double worst = 0;
  for (double pitch = 0.05; pitch < 0.3; pitch *= 1.0001) {
    const Field a = octave_field(pitch, time_pitch, 5), b = octave_field(pitch * 1.0001, time_pitch, 5);
    EXPECT_NEAR(a.weight[0] * a.weight[0] + a.weight[1] * a.weight[1], 1, 4e-16);
    worst = std::max(worst, std::abs(field_at(a, 0.31, -0.77, 0.2) - field_at(b, 0.31, -0.77, 0.2)));
  }
  EXPECT_LE(worst, 2e-3);
  const Field rung = octave_field(0.0625, time_pitch, 5);  // 64 h = 4: lattice 2 alone
  EXPECT_EQ(rung.weight, (std::array<double, 2>{1, 0}));
  EXPECT_EQ(rung.lattice[0].stream, 2u);
  EXPECT_EQ(rung.lattice[0].pitch, 0.0625);
}

}  // namespace
}  // namespace scotopic::noise

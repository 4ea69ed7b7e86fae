// Functions of one variable at every float, against extended precision, and that against 256 bits.
//   SCOTOPIC_STRIDE=1     the long form, all 2^32 bit patterns (minutes a function; default: every 4096th,
//   and edges);
//                         one function alone by --gtest_filter='*/OneVariable.*/gain_float'
//   SCOTOPIC_HISTOGRAM_ULP=FILE  adds the share of results in each octave of ulp
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include "properties/mpfr_number.h"

namespace scotopic::test {

using Extended = long double;

// floor(log2 |x|) of normal numbers, from their bits: ilogb() would take most of the sweep's time.
inline int exponent_of(double x) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023;
}
inline int exponent_of(Extended x) {
  std::uint16_t sign_and_exponent;
  std::memcpy(&sign_and_exponent, reinterpret_cast<const char*>(&x) + 8, sizeof sign_and_exponent);
  return (sign_and_exponent & 0x7fff) - 16383;
}
static_assert(std::numeric_limits<Extended>::digits == 64, "written for the x87's 80 bits");

// Spacing of numbers of `digits` mantissa bits at `x`, not below that of the type's smallest numbers.
inline Extended spacing(Extended x, int digits, int least_exponent) {
  const int exponent = std::max(exponent_of(x), least_exponent) - digits + 1;
  // -1074 at least: a power of two that double holds, subnormal or not.
  return exponent >= -1022
             ? Extended(std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52))
             : std::ldexp(1.0L, exponent);
}
inline Extended ulp_of_double(Extended x) { return spacing(x, 53, -1022); }
inline Extended ulp_of_float(Extended x) { return spacing(x, 24, -126); }
// Of quantities that end in 0, like m and lightness: spacing at 1, or at x if larger.
inline Extended ulp_at_1(Extended x) { return spacing(std::max(1.0L, std::abs(x)), 53, -1022); }

struct Function {
  const char* name;
  float from, to;  // domain
  double bound;    // ulp
  double (*got)(float);
  Extended (*exact)(const Extended&);
  Mp (*exact_in_256_bits)(const Mp&);
  Extended (*ulp)(Extended);
};
inline void PrintTo(const Function& f, std::ostream* out) { *out << f.name; }

struct WorstFloat {
  double ulp = 0;
  float where = 0;
  long tested = 0, not_finite = 0;
  std::array<long, 32> octaves{};

  void add(const Function& f, float x) {
    if (!(x >= f.from && x <= f.to)) return;
    const double got = f.got(x);
    ++tested;
    if (!std::isfinite(got)) {
      if (++not_finite == 1) where = x;
      return;
    }
    const Extended exact = f.exact(x);
    const auto error = static_cast<double>(std::abs(got - exact) / f.ulp(exact));
    const int octave = std::clamp(16 + exponent_of(error), 0, 31);
    ++octaves[static_cast<std::size_t>(octave)];
    if (error > ulp) ulp = error, where = x;
  }
  void add(const WorstFloat& other) {
    if (other.ulp > ulp) ulp = other.ulp, where = other.where;
    tested += other.tested, not_finite += other.not_finite;
    for (std::size_t i = 0; i < octaves.size(); ++i) octaves[i] += other.octaves[i];
  }
};

// Constants at which a formula changes, and the floats around them.
inline std::vector<float> edges() {
  constexpr float tiny = std::numeric_limits<float>::denorm_min(), huge = std::numeric_limits<float>::max();
  std::vector<float> out = {0,      -0.0f,    tiny,   0x1p-126f, huge,           1,        5,
                            4.998f, 0.00203f, 0.001f, 1e-5f,     216.0f / 24389, 6.0f / 29};
  const std::size_t count = out.size();
  for (std::size_t i = 0; i < count; ++i)
    for (const float towards : {-INFINITY, INFINITY}) {
      float x = out[i];
      for (int k = 0; k < 8; ++k) out.push_back(x = std::nextafter(x, towards));
    }
  return out;
}

inline WorstFloat sweep(const Function& f, std::uint64_t stride) {
  constexpr std::uint64_t patterns = std::uint64_t{1} << 32;
  const std::size_t threads = stride < 64 ? std::max(1u, std::thread::hardware_concurrency()) : 1;
  std::vector<WorstFloat> worst(threads);
  std::vector<std::thread> running;
  for (std::size_t t = 0; t < threads; ++t)
    running.emplace_back([&, t] {
      for (std::uint64_t bits = t * stride; bits < patterns; bits += threads * stride)
        worst[t].add(f, std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    });
  for (auto& thread : running) thread.join();
  for (std::size_t t = 1; t < threads; ++t) worst[0].add(worst[t]);
  for (const float x : edges()) worst[0].add(f, x);
  return worst[0];
}

/// Sweeps one function and holds it to its bound.
inline void expect_within_bound(const Function& f) {
  const char* text = std::getenv("SCOTOPIC_STRIDE");
  const WorstFloat worst = sweep(f, text ? std::max(1ull, std::strtoull(text, nullptr, 10)) : 4096);
  std::printf("%-28s worst %.3g ulp (bound %g) at %.9g, %ld floats\n", f.name, worst.ulp, f.bound,
              static_cast<double>(worst.where), worst.tested);
  EXPECT_LE(worst.ulp, f.bound) << "at " << worst.where;
  EXPECT_EQ(worst.not_finite, 0) << "first at " << worst.where;
  EXPECT_GT(worst.tested, 1000);
  if (const char* path = std::getenv("SCOTOPIC_HISTOGRAM_ULP")) {
    std::ofstream histogram(path, std::ios::app);
    for (std::size_t i = 0; i < worst.octaves.size(); ++i)
      histogram << f.name << ',' << static_cast<int>(i) - 16 << ','
                << static_cast<double>(worst.octaves[i]) / static_cast<double>(worst.tested) << '\n';
  }
}

/// Floats of the domain that the judge itself is judged at: the edges, and some thousand bit patterns evenly
/// spaced.
inline std::vector<float> judged_at(const Function& f) {
  std::vector<float> out;
  const auto add = [&](float x) {
    if (x >= f.from && x <= f.to) out.push_back(x);
  };
  for (const float x : edges()) add(x);
  const auto place = [](float x) {  // the place of a float among all, -0 being +0
    const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(std::abs(x)));
    return std::signbit(x) ? -bits : bits;
  };
  const std::int64_t first = place(f.from), span = place(f.to) - first;
  for (std::int64_t i = 0; i < 1500; ++i) {
    const std::int64_t at = first + span * i / 1499;
    const auto size = std::bit_cast<float>(static_cast<std::uint32_t>(std::abs(at)));
    add(at < 0 ? -size : size);
  }
  return out;
}

/// The judge in long double against the same formula in 256 bits: within a hundredth of the ulp it judges by.
inline void expect_sound_judge(const Function& f) {
  double worst = 0;
  float where = 0;
  const std::vector<float> floats = judged_at(f);
  for (const float x : floats) {
    const Extended judge = f.exact(x);
    const Mp gap = f.exact_in_256_bits(Mp(x)) - Mp::from(judge);
    const double error = std::abs(static_cast<double>(gap)) / static_cast<double>(f.ulp(judge));
    if (!(error <= worst)) worst = error, where = x;
  }
  std::printf("%-28s judge within %.2g ulp at %zu floats\n", f.name, worst, floats.size());
  EXPECT_LE(worst, 0.01) << "at " << where;
  EXPECT_GE(floats.size(), 1000u);
}

class OneVariable : public testing::TestWithParam<Function> {};

}  // namespace scotopic::test

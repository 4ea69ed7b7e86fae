// Every function of one variable at every float, against extended precision: the bound of each, in ulp.
//   SCOTOPIC_STRIDE=1     the long form, all 2^32 bit patterns (minutes a function; default: every 4096th, and edges)
//   SCOTOPIC_HISTOGRAM_ULP=FILE  writes how many results fell into each octave of ulp
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "acuity/cutoff.h"
#include "acuity/simd-inl.h"
#include "adaptation/mesopic.h"
#include "adaptation/pupil.h"
#include "appearance/colour_difference.h"
#include "appearance/constants.h"
#include "properties/mpfr_reference.h"

namespace scotopic::test {
namespace {

using Extended = long double;

// Spacing of numbers of `digits` mantissa bits at `x`, not below that of the type's smallest numbers.
Extended spacing(Extended x, int digits, int least_exponent) {
  const int exponent = x == 0 ? least_exponent : std::max(std::ilogb(x), least_exponent);
  return std::ldexp(1.0L, exponent - digits + 1);
}
Extended ulp_of_double(Extended x) { return spacing(x, 53, -1022); }
Extended ulp_of_float(Extended x) { return spacing(x, 24, -126); }
// Of quantities that end in 0, like m and lightness: spacing at 1, or at x if larger.
Extended ulp_at_1(Extended x) { return spacing(std::max(1.0L, std::abs(x)), 53, -1022); }

struct Function {
  const char* name;
  float from, to;  // domain
  double bound;    // ulp
  std::function<double(float)> got;
  std::function<Extended(Extended)> exact;
  Extended (*ulp)(Extended);
};

// Lane 0 of the acuity filter's float functions.
float lab_f_float(float t) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 4> d;
  return hn::GetLane(acuity::HWY_NAMESPACE::lab_f(d, hn::Set(d, t)));
}
float lab_f_inverse_float(float f) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 4> d;
  return hn::GetLane(acuity::HWY_NAMESPACE::lab_f_inverse(d, hn::Set(d, f)));
}

Extended exact_lab_f(Extended t) {
  return t > 216.0L / 24389 ? std::cbrt(t) : t * 841 / 108 + 4.0L / 29;
}

constexpr float tiny = std::numeric_limits<float>::denorm_min(), huge = std::numeric_limits<float>::max();

const std::vector<Function>& functions() {
  static const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
  static const Kernel<float> kernel_float(kernel_preset(Model::kirk2011), 1.0);
  const auto exact_gain = [](Extended q) { return 1 / std::sqrt(1 + std::max(0.0L, 0.33L * q)); };
  const auto exact_trolands = [](Extended la) {
    const Extended d = exact_pupil_diameter(la);
    return std::atan(1.0L) * d * d;
  };
  static const std::vector<Function> all = {
      {"gain (double)", -huge, huge, 3, [](float q) { return kernel.gains({static_cast<double>(q), 0, 0}, 0)[0]; },
       exact_gain, ulp_of_double},
      {"gain (float)", -huge, 1e38f, 2.5, [](float q) { return kernel_float.gains({q, 0, 0}, 0)[0]; }, exact_gain,
       ulp_of_float},
      {"mesopic coefficient", 0, huge, 2, [](float l) { return mesopic_coefficient(static_cast<double>(l)); },
       [](Extended l) { return exact_mesopic_coefficient(l, 2.4648L); }, ulp_at_1},
      {"pupil diameter", 0, huge, 2, [](float l) { return pupil_diameter_mm(static_cast<double>(l)); },
       [](Extended l) { return exact_pupil_diameter(l); }, ulp_of_double},
      {"trolands", 0, huge, 6, [](float l) { return trolands_per_luminance(static_cast<double>(l)); }, exact_trolands,
       ulp_of_double},
      {"chroma factor (double)", 0, huge, 4, [](float l) { return chroma_factor(static_cast<double>(l)); },
       [](Extended l) { return exact_chroma_factor(l); }, ulp_of_double},
      {"chroma factor (float)", 0, 1e38f, 4, [](float l) { return chroma_factor(l); },
       [](Extended l) { return exact_chroma_factor(l); }, ulp_of_float},
      {"acuity cutoff", 0, huge, 32, [](float l) { return acuity_cutoff(static_cast<double>(l)); },
       [](Extended l) { return 17.25L * std::atan(1.4L * std::log10(std::max(l, 1e-5L)) + 0.35L) + 25.72L; },
       ulp_at_1},
      {"Lab lightness", -1e30f, 1e30f, 5,
       [](float t) { return lab_from_xyz({0, static_cast<double>(t), 0}).lightness / 116; },
       [](Extended t) { return exact_lab_f(t) - 16.0L / 116; }, ulp_at_1},
      {"acuity Lab f (float)", 1e-3f, 1e10f, 32, lab_f_float, exact_lab_f, ulp_of_float},
      {"acuity Lab f inverse (float)", 0.21f, 2e3f, 2, lab_f_inverse_float,
       [](Extended f) { return f > 6.0L / 29 ? f * f * f : (f - 4.0L / 29) * 108 / 841; }, ulp_of_float},
  };
  return all;
}

struct Worst {
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
    const int octave = error > 0 ? std::min(31, std::max(0, 16 + std::ilogb(error))) : 0;
    ++octaves[static_cast<std::size_t>(octave)];
    if (error > ulp) ulp = error, where = x;
  }
  void add(const Worst& other) {
    if (other.ulp > ulp) ulp = other.ulp, where = other.where;
    tested += other.tested, not_finite += other.not_finite;
    for (std::size_t i = 0; i < octaves.size(); ++i) octaves[i] += other.octaves[i];
  }
};

// Constants at which a formula changes, and the floats around them.
std::vector<float> edges() {
  std::vector<float> out = {0, -0.0f, tiny, 0x1p-126f, huge, 1, 5, 4.998f, 0.00203f, 0.001f, 1e-5f, 216.0f / 24389, 6.0f / 29};
  const std::size_t count = out.size();
  for (std::size_t i = 0; i < count; ++i)
    for (const float towards : {-INFINITY, INFINITY}) {
      float x = out[i];
      for (int k = 0; k < 8; ++k) out.push_back(x = std::nextafter(x, towards));
    }
  return out;
}

Worst sweep(const Function& f, std::uint64_t stride) {
  constexpr std::uint64_t patterns = std::uint64_t{1} << 32;
  const std::size_t threads = stride < 64 ? std::max(1u, std::thread::hardware_concurrency()) : 1;
  std::vector<Worst> worst(threads);
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

TEST(OneVariable, every_float_is_within_its_function_s_bound) {
  const char* text = std::getenv("SCOTOPIC_STRIDE");
  const std::uint64_t stride = text ? std::max(1ull, std::strtoull(text, nullptr, 10)) : 4096;
  std::ofstream histogram;
  if (const char* path = std::getenv("SCOTOPIC_HISTOGRAM_ULP")) histogram.open(path);
  std::printf("%-30s %10s %8s %14s %12s\n", "", "worst ulp", "bound", "at", "floats");
  for (const Function& f : functions()) {
    const Worst worst = sweep(f, stride);
    std::printf("%-30s %10.3g %8.3g %14.7g %12ld\n", f.name, worst.ulp, f.bound, static_cast<double>(worst.where),
                worst.tested);
    EXPECT_LE(worst.ulp, f.bound) << f.name << " at " << worst.where;
    EXPECT_EQ(worst.not_finite, 0) << f.name << " first at " << worst.where;
    EXPECT_GT(worst.tested, 1000) << f.name;
    if (histogram.is_open())
      for (std::size_t i = 0; i < worst.octaves.size(); ++i)
        histogram << f.name << ',' << static_cast<int>(i) - 16 << ',' << worst.octaves[i] << '\n';
  }
}

}  // namespace
}  // namespace scotopic::test

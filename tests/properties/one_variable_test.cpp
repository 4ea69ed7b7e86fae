// Every function of one variable at every float, against extended precision: the bound of each, in ulp.
//   SCOTOPIC_STRIDE=1     the long form, all 2^32 bit patterns (minutes a function; default: every 4096th, and edges);
//                         one function alone by --gtest_filter='*/OneVariable.*/gain_float'
//   SCOTOPIC_HISTOGRAM_ULP=FILE  adds the share of results in each octave of ulp
#include <gtest/gtest.h>
#include <hwy/highway.h>

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
#include <thread>
#include <vector>

#include "acuity/cutoff.h"
#include "acuity/simd-inl.h"
#include "adaptation/mesopic.h"
#include "adaptation/pupil.h"
#include "appearance/batch.h"
#include "appearance/colour_difference.h"
#include "appearance/constants.h"
#include "properties/mpfr_reference.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

using Extended = long double;

// floor(log2 |x|) of normal numbers, from their bits: ilogb() would take most of the sweep's time.
int exponent_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52 & 0x7ff) - 1023; }
int exponent_of(Extended x) {
  std::uint16_t sign_and_exponent;
  std::memcpy(&sign_and_exponent, reinterpret_cast<const char*>(&x) + 8, sizeof sign_and_exponent);
  return (sign_and_exponent & 0x7fff) - 16383;
}
static_assert(std::numeric_limits<Extended>::digits == 64, "written for the x87's 80 bits");

// Spacing of numbers of `digits` mantissa bits at `x`, not below that of the type's smallest numbers.
Extended spacing(Extended x, int digits, int least_exponent) {
  const int exponent = std::max(exponent_of(x), least_exponent) - digits + 1;
  // -1074 at least: a power of two that double holds, subnormal or not.
  return exponent >= -1022 ? Extended(std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52))
                           : std::ldexp(1.0L, exponent);
}
Extended ulp_of_double(Extended x) { return spacing(x, 53, -1022); }
Extended ulp_of_float(Extended x) { return spacing(x, 24, -126); }
// Of quantities that end in 0, like m and lightness: spacing at 1, or at x if larger.
Extended ulp_at_1(Extended x) { return spacing(std::max(1.0L, std::abs(x)), 53, -1022); }

struct Function {
  const char* name;
  float from, to;  // domain
  double bound;    // ulp
  double (*got)(float);
  Extended (*exact)(Extended);
  Extended (*ulp)(Extended);
};
void PrintTo(const Function& f, std::ostream* out) { *out << f.name; }

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

// The operator in float on a light that rods do not see, eye dark: what MES2 leaves of its luminance, 1 at 4.998 cd/m2,
// 0 at .00203. By the batch's own logarithm and polynomial.
float mesopic_share_of_batch(float luminance, Precision precision) {
  static const AppearanceParameters parameters = [] {
    AppearanceParameters p;
    p.adaptation = 1e-30;
    p.white_luminance = 1;
    p.xyz_from_rgb = rec709;
    p.strength.shift = p.strength.chroma = 0;
    return p;
  }();
  static const AppearanceBatch single(parameters), dual(parameters, Precision::dual);
  float r = luminance, g = luminance, b = luminance;
  const float rod = 0;
  PixelRows rows;
  rows.r = &r, rows.g = &g, rows.b = &b, rows.rod = &rod, rows.count = 1;
  (precision == Precision::single ? single : dual).apply(rows);
  return g / luminance;
}

Extended exact_share(Extended luminance) {
  const Extended m = exact_mesopic_coefficient(luminance, 2.4648L), rods = (1 - m) * 2.4648L * 683 / 1699;
  return m / (m + rods);
}
// Of a share that ends in 0: spacing of floats at 1.
Extended ulp_of_float_at_1(Extended) { return 0x1p-23L; }

Extended exact_gain(Extended q) { return 1 / std::sqrt(1 + std::max(0.0L, 0.33L * q)); }
Extended exact_trolands(Extended la) {
  const Extended d = exact_pupil_diameter(la);
  return std::atan(1.0L) * d * d;
}
Extended exact_cutoff(Extended l) {
  return 17.25L * std::atan(1.4L * std::log10(std::max(l, 1e-5L)) + 0.35L) + 25.72L;
}
Extended exact_pupil(Extended la) { return exact_pupil_diameter(la); }
Extended exact_chroma(Extended l) { return exact_chroma_factor(l); }
Extended exact_mesopic(Extended l) { return exact_mesopic_coefficient(l, 2.4648L); }

constexpr float tiny = std::numeric_limits<float>::denorm_min(), huge = std::numeric_limits<float>::max();
const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
const Kernel<float> kernel_float(kernel_preset(Model::kirk2011), 1.0);

const Function functions[] = {
    {"gain_double", -huge, huge, 3, [](float q) { return kernel.gains({static_cast<double>(q), 0, 0}, 0)[0]; }, exact_gain,
     ulp_of_double},
    {"gain_float", -huge, 1e38f, 3, [](float q) -> double { return kernel_float.gains({q, 0, 0}, 0)[0]; }, exact_gain,
     ulp_of_float},
    {"mesopic_coefficient", 0, huge, 2, [](float l) { return mesopic_coefficient(static_cast<double>(l)); }, exact_mesopic,
     ulp_at_1},
    {"mesopic_share_float", 1e-20f, 4.9999f, 4,
     [](float l) -> double { return mesopic_share_of_batch(l, Precision::single); }, exact_share, ulp_of_float_at_1},
    {"mesopic_share_dual", 1e-20f, 4.9999f, 1.5,
     [](float l) -> double { return mesopic_share_of_batch(l, Precision::dual); }, exact_share, ulp_of_float_at_1},
    {"pupil_diameter", 0, huge, 2, [](float l) { return pupil_diameter_mm(static_cast<double>(l)); },
     exact_pupil, ulp_of_double},
    {"trolands", 0, huge, 6, [](float l) { return trolands_per_luminance(static_cast<double>(l)); }, exact_trolands,
     ulp_of_double},
    {"chroma_factor_double", 0, huge, 4, [](float l) { return chroma_factor(static_cast<double>(l)); },
     exact_chroma, ulp_of_double},
    {"chroma_factor_float", 0, 1e38f, 4, [](float l) -> double { return chroma_factor(l); },
     exact_chroma, ulp_of_float},
    {"acuity_cutoff", 0, huge, 32, [](float l) { return acuity_cutoff(static_cast<double>(l)); }, exact_cutoff, ulp_at_1},
    {"lab_lightness", -1e30f, 1e30f, 5,
     [](float t) { return lab_from_xyz({0, static_cast<double>(t), 0}).lightness / 116; },
     [](Extended t) { return exact_lab_f(t) - 16.0L / 116; }, ulp_at_1},
    {"acuity_lab_f_float", 1e-3f, 1e10f, 9, [](float t) -> double { return lab_f_float(t); }, exact_lab_f, ulp_of_float},
    {"acuity_lab_f_inverse_float", 0.21f, 2e3f, 2, [](float f) -> double { return lab_f_inverse_float(f); },
     [](Extended f) { return f > 6.0L / 29 ? f * f * f : (f - 4.0L / 29) * 108 / 841; }, ulp_of_float},
};

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
    const int octave = std::clamp(16 + exponent_of(error), 0, 31);
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

class OneVariable : public testing::TestWithParam<Function> {};

TEST_P(OneVariable, every_float_is_within_its_function_s_bound) {
  const Function& f = GetParam();
  const char* text = std::getenv("SCOTOPIC_STRIDE");
  const Worst worst = sweep(f, text ? std::max(1ull, std::strtoull(text, nullptr, 10)) : 4096);
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

INSTANTIATE_TEST_SUITE_P(All, OneVariable, testing::ValuesIn(functions),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace scotopic::test

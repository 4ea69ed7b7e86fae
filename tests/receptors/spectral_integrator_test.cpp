#include "receptors/spectral_integrator.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "receptors/support.h"
#include "receptors/tables.h"
#include "support/simd_targets.h"

namespace scotopic {
namespace {

struct Signals {
  explicit Signals(std::size_t count) {
    for (std::size_t s = 0; s < signal_count; ++s) {
      planes[s].assign(count + 1, -7.0f);  // one more, to see that nothing is written past the end
      rows[s] = planes[s].data();
    }
  }
  std::array<std::vector<float>, signal_count> planes;
  SignalRows rows{};
};

// Bands as a renderer of night scenes leaves them: twelve decades, smooth and spiky.
std::vector<float> night_bands(std::size_t bands, std::size_t pixels) {
  std::mt19937 random(20240607);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<float> values(bands * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double level = std::pow(10.0, -9.0 + 12.0 * unit(random));
    for (std::size_t b = 0; b < bands; ++b)
      values[b * pixels + i] =
          static_cast<float>(level * (0.05 + std::pow(unit(random), 1.0 + static_cast<double>(i % 9))));
  }
  return values;
}

std::vector<std::uint16_t> halves(const std::vector<float>& values) {
  std::vector<std::uint16_t> bits;
  for (const float value : values) bits.push_back(Imath::half(value * 1e3f).bits());
  return bits;
}

// Equal bits, or NaN both: whose payload a sum of two NaN keeps is the hardware's affair.
::testing::AssertionResult same(const std::vector<float>& a, const std::vector<float>& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::memcmp(&a[i], &b[i], sizeof(float)) != 0 && !(std::isnan(a[i]) && std::isnan(b[i])))
      return ::testing::AssertionFailure() << "pixel " << i << ": " << a[i] << " and " << b[i];
  return ::testing::AssertionSuccess();
}

TEST(SpectralIntegrator, signals_equal_the_sum_in_long_double) {
  const std::size_t pixels = 1000;
  test::WorstError worst_dual, worst_single;
  for (const double step : {1.0, 5.0, 10.0, 40.0}) {
    const BandGrid grid(test::evenly(380.0, step, static_cast<std::size_t>(400.0 / step) + 1));
    const SpectralWeights weights = emissive_weights(grid, BandSampling::bin, BandUnit::per_nm);
    const std::vector<float> bands = night_bands(grid.size(), pixels);
    Signals dual(pixels), single(pixels);
    SpectralIntegrator(weights, Accumulation::dual).integrate(bands.data(), pixels, pixels, dual.rows);
    SpectralIntegrator(weights, Accumulation::single).integrate(bands.data(), pixels, pixels, single.rows);
    for (const Signal signal : all_signals)
      for (std::size_t i = 0; i < pixels; ++i) {
        long double truth = 0.0L;
        for (std::size_t b = 0; b < grid.size(); ++b)
          truth += static_cast<long double>(weights.of[index(signal)][b]) * bands[b * pixels + i];
        const double expected = static_cast<double>(truth);
        const std::string where = "signal " + std::to_string(index(signal)) + " step " + std::to_string(step);
        worst_dual.add(where, dual.planes[index(signal)][i], expected, 6.1e-8 * expected);
        worst_single.add(where, single.planes[index(signal)][i], expected, 1e-6 * expected);
      }
  }
  worst_dual.expect_within("sums in double");
  worst_single.expect_within("sums in float");
}

TEST(SpectralIntegrator, one_nanometre_points_equal_the_standard_sum_of_the_spectrum) {
  const std::size_t pixels = 1;
  const BandGrid grid(test::evenly(360.0, 1.0, 471));
  const SpectralIntegrator integrator(emissive_weights(grid, BandSampling::point, BandUnit::per_nm),
                                      Accumulation::dual);
  test::WorstError worst;
  for (const TabulatedCurve* light :
       {&tables::illuminant_cie_d65_d65, &tables::illuminant_cie_a_a, &tables::lamps_houser_2013_hps,
        &tables::lamps_houser_2013_led3000, &tables::lamps_houser_2013_led4000}) {
    std::vector<float> bands;
    std::vector<double> rounded;
    for (std::size_t b = 0; b < grid.size(); ++b)
      bands.push_back(static_cast<float>(light->at(grid.centre(b))));
    rounded.assign(bands.begin(), bands.end());
    Signals out(pixels);
    integrator.integrate(bands.data(), pixels, pixels, out.rows);
    for (const Signal signal : all_signals) {
      const double truth = signal_per_watt(signal) * integrate({360.0, 1.0, rounded}, sensitivity(signal));
      worst.add("signal " + std::to_string(index(signal)), out.planes[index(signal)][0], truth, 1e-7 * truth);
    }
  }
  worst.expect_within("image of 1 nm points against the spectrum");
}

TEST(SpectralIntegrator, every_instruction_set_and_grouping_gives_the_same_bits) {
  const std::size_t pixels = 5003;
  const BandGrid grid(test::evenly(380.0, 5.0, 81));
  const SpectralWeights weights = emissive_weights(grid, BandSampling::bin, BandUnit::per_nm);
  const std::vector<float> bands = night_bands(grid.size(), pixels);
  std::vector<std::uint16_t> half_bands = halves(bands);
  // Inf, NaN, negative numbers and the smallest subnormal, each in a pixel of its own.
  const std::uint16_t special[] = {0x7c00, 0xfc00, 0x7e01, 0xc200, 0x0001, 0x8001};
  for (std::size_t k = 0; k < std::size(special); ++k) half_bands[40 * pixels + 17 * k] = special[k];
  int targets = 0;
  for (const Accumulation accumulation : {Accumulation::single, Accumulation::dual}) {
    const SpectralIntegrator integrator(weights, accumulation);
    Signals first(pixels), first_half(pixels);
    integrator.integrate(bands.data(), pixels, pixels, first.rows);
    integrator.integrate_half(half_bands.data(), pixels, pixels, first_half.rows);
    test::on_every_target([&](const char* target) {
      Signals out(pixels), half_out(pixels);
      for (std::size_t begin = 0, length = 1; begin < pixels; begin += length, length = length * 3 + 1) {
        length = std::min(length, pixels - begin);
        SignalRows rows = out.rows, half_rows = half_out.rows;
        for (std::size_t s = 0; s < signal_count; ++s) {
          rows[s] += begin;
          half_rows[s] += begin;
        }
        integrator.integrate(bands.data() + begin, pixels, length, rows);
        integrator.integrate_half(half_bands.data() + begin, pixels, length, half_rows);
      }
      for (std::size_t s = 0; s < signal_count; ++s) {
        EXPECT_TRUE(same(first.planes[s], out.planes[s])) << target << " signal " << s;
        EXPECT_TRUE(same(first_half.planes[s], half_out.planes[s])) << target << " half, signal " << s;
      }
      ++targets;
    });
  }
  std::printf("%d runs of an instruction set\n", targets);
  EXPECT_GE(targets, 2);
}

TEST(SpectralIntegrator, lmsr_alone_is_the_same_as_with_xyz) {
  const std::size_t pixels = 70;
  const BandGrid grid(test::evenly(400.0, 10.0, 31));
  const SpectralIntegrator integrator(emissive_weights(grid, BandSampling::bin, BandUnit::per_nm),
                                      Accumulation::dual);
  const std::vector<float> bands = night_bands(grid.size(), pixels);
  Signals all(pixels), four(pixels);
  for (std::size_t s = index(Signal::x); s < signal_count; ++s) four.rows[s] = nullptr;
  integrator.integrate(bands.data(), pixels, pixels, all.rows);
  integrator.integrate(bands.data(), pixels, pixels, four.rows);
  for (std::size_t s = 0; s < index(Signal::x); ++s) EXPECT_EQ(all.planes[s], four.planes[s]);
  for (std::size_t s = 0; s < signal_count; ++s)
    EXPECT_EQ(all.planes[s][pixels], -7.0f) << "wrote past the end";
}

TEST(SpectralIntegrator, a_broken_band_stays_in_its_pixel) {
  const std::size_t pixels = 33;
  const BandGrid grid(test::evenly(400.0, 10.0, 31));
  const SpectralIntegrator integrator(emissive_weights(grid, BandSampling::bin, BandUnit::per_nm),
                                      Accumulation::dual);
  std::vector<float> bands = night_bands(grid.size(), pixels);
  Signals clean(pixels), broken(pixels);
  integrator.integrate(bands.data(), pixels, pixels, clean.rows);
  bands[12 * pixels + 5] = std::numeric_limits<float>::quiet_NaN();
  bands[20 * pixels + 32] = std::numeric_limits<float>::infinity();
  integrator.integrate(bands.data(), pixels, pixels, broken.rows);
  for (std::size_t i = 0; i < pixels; ++i) {
    const bool finite = std::isfinite(broken.planes[index(Signal::y)][i]);
    EXPECT_EQ(finite, i != 5 && i != 32) << "pixel " << i;
    EXPECT_TRUE(!finite || broken.planes[3][i] == clean.planes[3][i]) << "pixel " << i;
  }
}

TEST(SpectralIntegrator, bands_that_weigh_nothing_are_named) {
  const SpectralWeights weights = emissive_weights(BandGrid({300.0, 320.0, 550.0, 560.0, 1000.0, 1100.0}),
                                                   BandSampling::point, BandUnit::per_nm);
  EXPECT_EQ(weighed_bands(weights), (std::vector<bool>{false, false, true, true, false, false}));
}

}  // namespace
}  // namespace scotopic

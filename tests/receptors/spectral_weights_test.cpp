#include "receptors/spectral_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "receptors/receptor_space.h"
#include "receptors/support.h"
#include "receptors/tables.h"

namespace scotopic {
namespace {

const char* const names[] = {"l", "m", "s", "rod", "x", "y", "z"};

double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

// Integral of a curve by the midpoint rule on slices so thin that the rule's error is far below the
// tolerance.
double sliced_integral(const TabulatedCurve& curve, double low, double high) {
  const int slices = 200000;
  long double total = 0.0L;
  const double width = (high - low) / slices;
  for (int i = 0; i < slices; ++i) total += curve.at(low + (i + 0.5) * width);
  return static_cast<double>(total * width);
}

TEST(BandGrid, bins_meet_halfway_and_are_symmetric_at_the_ends) {
  const BandGrid grid({400.0, 410.0, 430.0, 434.0});
  const double edges[] = {395.0, 405.0, 420.0, 432.0, 436.0};
  for (std::size_t band = 0; band < grid.size(); ++band) {
    EXPECT_EQ(grid.lower_edge(band), edges[band]);
    EXPECT_EQ(grid.upper_edge(band), edges[band + 1]);
    EXPECT_EQ(grid.width(band), edges[band + 1] - edges[band]);
  }
}

TEST(SpectralWeights, bins_that_cover_a_sensitivity_take_in_all_of_it) {
  test::WorstError worst;
  for (const double step : {1.0, 5.0, 10.0, 13.7}) {
    const BandGrid grid(test::evenly(340.0, step, static_cast<std::size_t>(520.0 / step) + 1));
    const SpectralWeights weights = emissive_weights(grid, BandSampling::bin, BandUnit::per_nm);
    for (const Signal signal : all_signals) {
      const TabulatedCurve& curve = sensitivity(signal);
      // The area under straight lines: trapezia.
      const double area = curve.step_nm * (std::accumulate(curve.values.begin(), curve.values.end(), 0.0) -
                                           0.5 * (curve.values.front() + curve.values.back()));
      const std::string where = std::string(names[index(signal)]) + " in steps of " + std::to_string(step);
      worst.add(where, sum(weights.of[index(signal)]) / signal_per_watt(signal), area, 1e-12 * area);
      worst.add(where + ", share outside", weights.outside[index(signal)], 0.0, 1e-12);
    }
  }
  worst.expect_within("whole sensitivities");
}

TEST(SpectralWeights, uneven_bins_hold_the_integral_between_their_edges) {
  const BandGrid grid({402.3, 411.0, 440.7, 441.9, 500.05, 555.5, 700.0});
  const SpectralWeights weights = emissive_weights(grid, BandSampling::bin, BandUnit::per_nm);
  test::WorstError worst;
  for (const Signal signal : all_signals)
    for (std::size_t band = 0; band < grid.size(); ++band) {
      const double expected =
          signal_per_watt(signal) *
          sliced_integral(sensitivity(signal), grid.lower_edge(band), grid.upper_edge(band));
      worst.add(std::string(names[index(signal)]) + " band " + std::to_string(band),
                weights.of[index(signal)][band], expected, 1e-6 * expected + 1e-12);
    }
  worst.expect_within("bin weights");
}

TEST(SpectralWeights, points_one_nanometre_apart_are_the_standard_sum) {
  const BandGrid grid(test::evenly(380.0, 1.0, 401));
  const SpectralWeights weights = emissive_weights(grid, BandSampling::point, BandUnit::per_nm);
  test::WorstError worst;
  for (const Signal signal : all_signals)
    for (std::size_t band = 0; band < grid.size(); ++band)
      worst.add(std::string(names[index(signal)]) + " " + std::to_string(380 + band) + " nm",
                weights.of[index(signal)][band],
                signal_per_watt(signal) * sensitivity(signal).at(380.0 + static_cast<double>(band)), 1e-300);
  worst.expect_within("point weights");
}

TEST(SpectralWeights, radiance_of_a_band_is_its_width_times_radiance_per_nanometre) {
  const BandGrid grid({400.0, 410.0, 430.0, 434.0});
  for (const BandSampling sampling : {BandSampling::bin, BandSampling::point}) {
    const SpectralWeights per_nm = emissive_weights(grid, sampling, BandUnit::per_nm);
    const SpectralWeights per_band = emissive_weights(grid, sampling, BandUnit::per_band);
    for (std::size_t band = 0; band < grid.size(); ++band)
      EXPECT_DOUBLE_EQ(per_band.of[0][band] * grid.width(band), per_nm.of[0][band]);
  }
}

TEST(SpectralWeights, perfect_white_has_the_signals_of_the_illuminant_at_one_candela) {
  const BandGrid grid(test::evenly(380.0, 10.0, 41));
  test::WorstError worst;
  for (const TabulatedCurve* light :
       {&tables::illuminant_cie_d65_d65, &tables::illuminant_cie_a_a, &tables::lamps_houser_2013_hps}) {
    const SpectralWeights weights = reflective_weights(grid, BandSampling::bin, *light);
    const double luminance = photopic_luminance(*light).cdm2;
    for (const Signal signal : all_signals) {
      const double expected = signal_per_watt(signal) * integrate(*light, sensitivity(signal)) / luminance;
      // Exact integrals of straight lines against 1 nm sums: alike to 3e-4, lamps with lines included.
      worst.add(std::string(names[index(signal)]) + " peak " + std::to_string(light->values[0]),
                sum(weights.of[index(signal)]), expected, 3e-4);
    }
    EXPECT_NEAR(sum(weights.of[index(Signal::y)]), 1.0, 1e-6);
  }
  worst.expect_within("white under an illuminant");
}

TEST(SpectralWeights, light_outside_the_bands_is_reported) {
  // 400-700 nm, bins from 395 to 705.
  const SpectralWeights weights =
      emissive_weights(BandGrid(test::evenly(400.0, 10.0, 31)), BandSampling::bin, BandUnit::per_nm);
  for (const Signal signal : all_signals) {
    const TabulatedCurve& curve = sensitivity(signal);
    const double whole = sliced_integral(curve, curve.first_nm, curve.last_nm());
    EXPECT_NEAR(weights.outside[index(signal)], 1.0 - sliced_integral(curve, 395.0, 705.0) / whole, 1e-6);
  }
}

TEST(SpectralWeights, infrared_bands_weigh_nothing) {
  const SpectralWeights weights =
      emissive_weights(BandGrid({900.0, 950.0, 1000.0}), BandSampling::bin, BandUnit::per_nm);
  for (const Signal signal : all_signals) {
    EXPECT_EQ(sum(weights.of[index(signal)]), 0.0);
    EXPECT_EQ(weights.outside[index(signal)], 1.0);
  }
}

}  // namespace
}  // namespace scotopic

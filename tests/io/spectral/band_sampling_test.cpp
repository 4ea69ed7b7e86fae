// What bands cost: the same lamps through ever coarser bands, as bins and as points.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "receptors/spectral_weights.h"
#include "io/spectral/scene.h"

namespace scotopic {
namespace {

double rods_through_bands(const test::SceneSpectrum& spectrum, double step, BandSampling sampling) {
  const std::vector<double> centres = test::band_centres(380, step, 780);
  const SpectralWeights weights = emissive_weights(BandGrid(centres), sampling, BandUnit::per_nm);
  double sum = 0.0;
  for (std::size_t b = 0; b < centres.size(); ++b) {
    // A camera or renderer that samples points sees what the lamp has in that nanometre.
    const double half = sampling == BandSampling::bin ? step / 2 : 0.5;
    sum +=
        weights.of[index(Signal::rod)][b] * test::band_mean(spectrum, centres[b] - half, centres[b] + half);
  }
  return sum;
}

TEST(BandSampling, bins_of_ten_nanometres_hold_lamps_that_points_miss) {
  struct Row {
    const char* lamp;
    double bins, points_at_least;  // relative errors of the rod signal at 10 nm
  };
  std::printf("rod signal through bands, error in %%:\n%-8s %10s %10s %10s %10s %10s %10s\n", "lamp",
              "5 nm bin", "5 nm point", "10 nm bin", "10 nm point", "20 nm bin", "20 nm point");
  // Points see only one nanometre in ten of low-pressure sodium's two: 589 and 590 nm.
  for (const Row& row : {Row{"d65", 2e-3, 0.0}, Row{"a", 2e-3, 0.0}, Row{"moon", 2e-3, 0.0},
                         Row{"led4000", 4e-3, 0.0}, Row{"hps", 0.02, 0.02}, Row{"lps", 0.04, 0.99}}) {
    const test::SceneSpectrum light =
        test::lit({test::SceneSpectrum(471, 1.0)}, test::lamp(row.lamp), 0.1)[0];
    const double truth = test::true_signals(light)[index(Signal::rod)];
    std::printf("%-8s", row.lamp);
    for (const double step : {5.0, 10.0, 20.0})
      for (const BandSampling sampling : {BandSampling::bin, BandSampling::point}) {
        const double error = rods_through_bands(light, step, sampling) / truth - 1.0;
        std::printf(" %10.2f", 100 * error);
        if (step != 10.0) continue;
        const bool bins = sampling == BandSampling::bin;
        EXPECT_TRUE(bins ? std::abs(error) <= row.bins : std::abs(error) >= row.points_at_least) << row.lamp;
      }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace scotopic

// Rods from RGB against rods from the spectrum, over every measured reflectance there is: the table of
// docs/accuracy.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "receptors/receptor_space.h"
#include "receptors/rods.h"
#include "spectral/scene.h"

namespace scotopic {
namespace {

constexpr Vec3<double> d65_white = {0.95047, 1.0, 1.08883};

// Bradford (CIE 15 calls it a linear transform of cone-like responses): what a camera's white balance does.
Vec3<double> balanced(const Vec3<double>& xyz, const Vec3<double>& white) {
  const Matrix3<double> bradford{
      {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}}};
  const Vec3<double> from = bradford * white;
  const Vec3<double> to = bradford * d65_white;
  return inverse(bradford) *
         (diagonal<double>({to[0] / from[0], to[1] / from[1], to[2] / from[2]}) * (bradford * xyz));
}

struct Errors {
  std::vector<double> relative;
  double mean() const {
    double sum = 0.0;
    for (const double e : relative) sum += std::abs(e);
    return sum / static_cast<double>(relative.size());
  }
  double bias() const {
    double sum = 0.0;
    for (const double e : relative) sum += e;
    return sum / static_cast<double>(relative.size());
  }
  double quantile(double q) const {
    std::vector<double> sorted;
    for (const double e : relative) sorted.push_back(std::abs(e));
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::min(sorted.size() - 1,
                           static_cast<std::size_t>(q * static_cast<double>(sorted.size())))];
  }
};

Errors errors_under(const std::vector<test::SceneSpectrum>& surfaces, const std::string& lamp,
                    RodEstimate estimate, bool known) {
  const auto spectra = test::lit(surfaces, test::lamp(lamp), 1.0);
  const auto white = test::true_signals(test::lit({test::SceneSpectrum(471, 1.0)}, test::lamp(lamp), 1.0)[0]);
  const Vec3<double> white_xyz = {white[4], white[5], white[6]};
  const double lamp_sp = white[index(Signal::rod)] / rod_signal_per_scotopic_luminance();
  Errors errors;
  for (const auto& spectrum : spectra) {
    const auto truth = test::true_signals(spectrum);
    const Vec3<double> xyz = balanced({truth[4], truth[5], truth[6]}, white_xyz);
    const double rods = rod_signal_per_scotopic_luminance() *
                        scotopic_luminance_from_xyz(xyz, estimate, known ? lamp_sp : sp_ratio_d65);
    errors.relative.push_back(rods / truth[index(Signal::rod)] - 1.0);
  }
  return errors;
}

TEST(RodsFromColour, known_illuminants_cost_a_few_per_cent_and_unknown_ones_far_more) {
  std::vector<test::SceneSpectrum> surfaces;
  for (const char* set : {"munsell", "vrhel", "krinov"})
    for (auto& surface : test::reflectances(set)) surfaces.push_back(std::move(surface));
  std::printf(
      "rods from white-balanced colour, error in %% over %zu reflectances (mean, 95th percentile, max)\n",
      surfaces.size());
  std::printf(
      "| light | linear, S/P known | quadratic, S/P known | linear, taken for D65 (bias) "
      "|\n|---|---|---|---|\n");
  for (const char* lamp : {"d65", "moon", "a", "led4000", "led3000", "hps"}) {
    const Errors linear = errors_under(surfaces, lamp, RodEstimate::linear, true);
    const Errors quadratic = errors_under(surfaces, lamp, RodEstimate::quadratic, true);
    const Errors unknown = errors_under(surfaces, lamp, RodEstimate::linear, false);
    std::printf("| %s | %.1f, %.1f, %.0f | %.1f, %.1f, %.0f | %.1f, %.1f, %.0f (%+.0f) |\n", lamp,
                100 * linear.mean(), 100 * linear.quantile(0.95), 100 * linear.quantile(1),
                100 * quadratic.mean(), 100 * quadratic.quantile(0.95), 100 * quadratic.quantile(1),
                100 * unknown.mean(), 100 * unknown.quantile(0.95), 100 * unknown.quantile(1),
                100 * unknown.bias());
    const bool smooth = std::string(lamp) == "d65" || std::string(lamp) == "moon" || std::string(lamp) == "a";
    if (smooth) {
      EXPECT_LE(linear.mean(), 0.08) << lamp;
      EXPECT_LE(quadratic.mean(), 0.07) << lamp;
    }
  }
  EXPECT_NEAR(errors_under(surfaces, "a", RodEstimate::linear, false).bias(), 0.75, 0.10);
  EXPECT_NEAR(errors_under(surfaces, "hps", RodEstimate::linear, false).bias(), 2.80, 0.40);
}

}  // namespace
}  // namespace scotopic

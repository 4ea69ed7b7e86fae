// Rods from RGB against rods from the spectrum, over every measured reflectance there is: the table of
// docs/accuracy.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "receptors/receptor_space.h"
#include "receptors/rods.h"
#include "io/spectral/scene.h"

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

// Scotopic luminance from XYZ as seen, not balanced, by Ward Larson, Rushmeier & Piatko (1997): no S/P ratio
// asked.
double ward_larson(const Vec3<double>& xyz) {
  return xyz[1] * (1.33 * (1 + (xyz[1] + xyz[2]) / xyz[0]) - 1.68);
}

// Errors of what an estimate makes of XYZ as it is, the lamp's colour left in.
template <typename Estimate>
Errors errors_unbalanced(const std::vector<test::SceneSpectrum>& surfaces, const std::string& lamp,
                         Estimate estimate) {
  Errors errors;
  for (const auto& spectrum : test::lit(surfaces, test::lamp(lamp), 1.0)) {
    const auto truth = test::true_signals(spectrum);
    const double rods =
        rod_signal_per_scotopic_luminance() * estimate(Vec3<double>{truth[4], truth[5], truth[6]});
    errors.relative.push_back(rods / truth[index(Signal::rod)] - 1.0);
  }
  return errors;
}

TEST(RodsFromColour, where_the_lamps_colour_is_left_in_the_picture_it_tells_of_the_lamp) {
  std::vector<test::SceneSpectrum> surfaces;
  for (const char* set : {"munsell", "vrhel", "krinov"})
    for (auto& surface : test::reflectances(set)) surfaces.push_back(std::move(surface));
  const auto estimated = [](RodEstimate kind) {
    return [kind](const Vec3<double>& xyz) { return scotopic_luminance_from_xyz(xyz, kind, sp_ratio_d65); };
  };
  std::printf("| light | linear | quadratic | Ward Larson 1997 |\n|---|---|---|---|\n");
  for (const char* lamp : {"d65", "moon", "a", "led4000", "led3000", "hps"}) {
    const Errors linear = errors_unbalanced(surfaces, lamp, estimated(RodEstimate::linear));
    const Errors quadratic = errors_unbalanced(surfaces, lamp, estimated(RodEstimate::quadratic));
    const Errors formula = errors_unbalanced(surfaces, lamp, ward_larson);
    std::printf("| %s |", lamp);
    for (const Errors& e : {linear, quadratic, formula})
      std::printf(" %.1f, %.1f, %.0f (%+.0f) |", 100 * e.mean(), 100 * e.quantile(0.95), 100 * e.quantile(1),
                  100 * e.bias());
    std::printf("\n");
    EXPECT_LT(linear.mean(), errors_under(surfaces, lamp, RodEstimate::linear, false).mean() + 1e-3) << lamp;
    const bool sodium = std::string(lamp) == "hps";
    EXPECT_LT(linear.mean(), sodium ? 0.70 : 0.17) << lamp;
    EXPECT_LT(quadratic.mean(), sodium ? 0.60 : 0.12) << lamp;
    EXPECT_LT(formula.mean(), sodium ? 0.45 : 0.10) << lamp;
  }
}

}  // namespace
}  // namespace scotopic

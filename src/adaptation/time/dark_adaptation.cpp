#include "adaptation/time/dark_adaptation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "adaptation/time/bleaching.h"
#include "adaptation/pupil.h"
#include "receptors/rods.h"

namespace scotopic {
namespace {

// A slow product of bleaching goes by 0.06 decades/min (from memory; Rushton's 400 s are 0.065).
constexpr double product_seconds = 60 / (0.06 * std::numbers::ln10);
// Time constants of what nerves do (Pattanaik et al. 2000, second-hand).
constexpr double rod_neural_seconds = 0.15;
constexpr double cone_neural_seconds = 0.08;
// Dark light, cd/m2: luminance of the background that doubles the absolute threshold. Rods second-hand, cones
// our choice.
constexpr double rod_dark_light = 1e-5;
constexpr double cone_dark_light = 0.05;
// Cones' absolute threshold in rods' ones, white light and large fields (plateau of dark adaptation; figure
// caption).
constexpr double cone_plateau = 1e3;
// Our calibration: a full bleach (X = 5 e^5) lifts the rods' threshold by 6 decades, the cones' by 3 over
// their own.
const double full_bleach = 5 * std::exp(5.0);
const double rod_background_gain = 1e6 / full_bleach;
const double cone_background_gain = 1e3 / full_bleach;
constexpr double rod_product_gain = 150;
constexpr double largest_exposure = 100;

// Illuminances of the retina, trolands.
struct Illuminance {
  double photopic, scotopic;

  explicit Illuminance(double luminance) noexcept
      : photopic(luminance > 0 ? luminance * trolands_per_luminance(luminance) : 0),
        scotopic(sp_ratio_d65 * photopic) {}
};

double product_rate(double scotopic) noexcept {
  return scotopic / rod_pigment.bleaching + 1 / product_seconds;
}

double product_at_equilibrium(double scotopic) noexcept {
  return scotopic / rod_pigment.bleaching / product_rate(scotopic);
}

double approach(double goal, double from, double seconds_over_constant) noexcept {
  return goal + (from - goal) * std::exp(-seconds_over_constant);
}

double threshold_of_rods(double luminance) noexcept { return 1 + luminance / rod_dark_light; }
double threshold_of_cones(double luminance) noexcept {
  return cone_plateau * (1 + luminance / cone_dark_light);
}

double excess_background(const Pigment& pigment, double bleached, double trolands) noexcept {
  const double kept_up = equivalent_background(pigment, bleached_at_equilibrium(pigment, trolands));
  return std::max(0.0, equivalent_background(pigment, bleached) - kept_up);
}

}  // namespace

AdaptationState adapted_state(double luminance) noexcept {
  const Illuminance light(luminance);
  return {bleached_at_equilibrium(rod_pigment, light.scotopic), product_at_equilibrium(light.scotopic),
          bleached_at_equilibrium(cone_pigment, light.photopic), luminance, luminance};
}

AdaptationState state_after(const AdaptationState& s, double luminance, double seconds) noexcept {
  const Illuminance light(luminance);
  return {
      bleached_after(rod_pigment, s.rod_bleached, light.scotopic, seconds),
      approach(product_at_equilibrium(light.scotopic), s.rod_product, product_rate(light.scotopic) * seconds),
      bleached_after(cone_pigment, s.cone_bleached, light.photopic, seconds),
      approach(luminance, s.rod_neural, seconds / rod_neural_seconds),
      approach(luminance, s.cone_neural, seconds / cone_neural_seconds)};
}

AdaptationThresholds thresholds_of(const AdaptationState& s, double luminance) noexcept {
  const Illuminance light(luminance);
  const double product = std::max(0.0, s.rod_product - product_at_equilibrium(light.scotopic));
  const double rods = rod_background_gain * excess_background(rod_pigment, s.rod_bleached, light.scotopic);
  const double cones =
      cone_background_gain * excess_background(cone_pigment, s.cone_bleached, light.photopic);
  AdaptationThresholds t{};
  t.rod_luminance = s.rod_neural + rod_dark_light * (rods + rod_product_gain * product);
  t.cone_luminance = s.cone_neural + cone_dark_light * cones;
  const double rod = threshold_of_rods(t.rod_luminance), cone = threshold_of_cones(t.cone_luminance);
  t.rod_log10 = std::log10(rod);
  t.cone_log10 = std::log10(cone);
  t.log10 = std::min(t.rod_log10, t.cone_log10);
  const double adapted = std::min(threshold_of_rods(luminance), threshold_of_cones(luminance));
  t.exposure = std::min(largest_exposure, adapted / std::min(rod, cone));
  return t;
}

bool adaptation_is_called_for(const AdaptationThresholds& t, double luminance) noexcept {
  constexpr double tolerance = 0.01;
  const auto differs = [&](double l) { return !(std::abs(l - luminance) <= tolerance * luminance); };
  return differs(t.rod_luminance) || differs(t.cone_luminance) || !(std::abs(t.exposure - 1) < tolerance);
}

AdaptationState state_after(std::span<const AdaptationPeriod> history) noexcept {
  AdaptationState state;
  for (const AdaptationPeriod& period : history) state = state_after(state, period.luminance, period.seconds);
  return state;
}

std::vector<AdaptationState> track_states(const AdaptationState& first, std::span<const double> luminances,
                                          double frame_rate) {
  std::vector<AdaptationState> states;
  states.reserve(luminances.size());
  for (std::size_t i = 0; i < luminances.size(); ++i)
    states.push_back(
        i == 0 ? first : state_after(states.back(), (luminances[i - 1] + luminances[i]) / 2, 1 / frame_rate));
  return states;
}

}  // namespace scotopic

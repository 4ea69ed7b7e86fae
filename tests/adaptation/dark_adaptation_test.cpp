// Adaptation in time, against tables made in double apart from this code and printed to the digits they have
// here.
#include "adaptation/time/dark_adaptation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "adaptation/mesopic.h"
#include "adaptation/pupil.h"

namespace scotopic {
namespace {

// Ten minutes in so much light, after darkness.
AdaptationState after_ten_minutes(double luminance) {
  return state_after(std::array{AdaptationPeriod{luminance, 600}});
}

AdaptationThresholds then_dark(const AdaptationState& state, double minutes) {
  return thresholds_of(state_after(state, 0, 60 * minutes), 0);
}

AdaptationState fully_bleached() { return {1, 1, 1, 0, 0}; }

constexpr double unknown = -1;

struct AfterLight {
  double minutes;
  std::array<double, 2> after_1000, after_3000, after_10000;  // rods, cones
};

constexpr std::array<AfterLight, 8> after_light = {
    {{0, {3.446, 3.223}, {4.588, 3.846}, {5.555, 5.094}},
     {1, {3.210, 3.026}, {4.349, 3.189}, {5.316, 4.086}},
     {5, {2.292, 3.000}, {3.395, 3.000}, {4.356, 3.000}},
     {7, {1.872, 3.000}, {2.924, 3.000}, {3.878, 3.000}},
     {10, {1.353, unknown}, {2.244, unknown}, {3.165, 3.000}},
     {20, {0.569, unknown}, {0.826, unknown}, {1.153, unknown}},
     {30, {0.223, unknown}, {0.358, unknown}, {0.464, unknown}},
     {40, {0.067, unknown}, {0.121, unknown}, {0.169, unknown}}}};

// At 0 min the nerves are taken to have got used to the dark: the table is of bleaching.
AdaptationState without_nerves(AdaptationState state) {
  state.rod_neural = state.cone_neural = 0;
  return state;
}

TEST(DarkAdaptation, thresholds_fall_as_the_table_has_it) {
  double worst = 0;
  const auto compare = [&](double luminance, double minutes, const std::array<double, 2>& expected) {
    const AdaptationThresholds t = then_dark(without_nerves(after_ten_minutes(luminance)), minutes);
    worst = std::max(worst, std::abs(t.rod_log10 - expected[0]));
    if (expected[1] != unknown) worst = std::max(worst, std::abs(t.cone_log10 - expected[1]));
    EXPECT_EQ(t.log10, std::min(t.rod_log10, t.cone_log10));
  };
  for (const AfterLight& row : after_light) {
    compare(1000, row.minutes, row.after_1000);
    compare(3000, row.minutes, row.after_3000);
    compare(10000, row.minutes, row.after_10000);
  }
  std::printf("thresholds: worst difference from the table %.2g decades\n", worst);
  EXPECT_LE(worst, 1e-3);
}

TEST(DarkAdaptation, a_full_bleach_takes_six_decades_and_forty_minutes) {
  constexpr std::array<std::array<double, 2>, 8> rows = {{{0, 6.0001},
                                                          {1, 4.9625},
                                                          {5, 3.0027},
                                                          {7, 3.0000},
                                                          {10, 3.0000},
                                                          {20, 1.4202},
                                                          {30, 0.5366},
                                                          {40, 0.2034}}};
  for (const auto& [minutes, threshold] : rows) {
    const AdaptationThresholds t = then_dark(fully_bleached(), minutes);
    EXPECT_NEAR(minutes == 0 ? t.rod_log10 : t.log10, threshold, 1e-3) << minutes;
  }
}

double break_minutes(const AdaptationState& state) {
  double low = 0, high = 30;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    const AdaptationThresholds t = then_dark(state, middle);
    (t.rod_log10 > t.cone_log10 ? low : high) = middle;
  }
  return low;
}

TEST(DarkAdaptation, rods_overtake_cones_later_after_more_light) {
  EXPECT_NEAR(break_minutes(after_ten_minutes(1000)), 1.88, 0.01);
  EXPECT_NEAR(break_minutes(after_ten_minutes(3000)), 6.68, 0.01);
  EXPECT_NEAR(break_minutes(after_ten_minutes(10000)), 10.70, 0.01);
  EXPECT_NEAR(break_minutes(fully_bleached()), 12.5, 0.06);
}

TEST(DarkAdaptation, ten_minutes_of_light_bleach_as_the_table_has_it) {
  const std::array<std::array<double, 3>, 3> rows = {
      {{1000, 0.172379, 0.070155}, {3000, 0.491541, 0.252500}, {10000, 0.831999, 0.663347}}};
  for (const auto& [luminance, rods, cones] : rows) {
    const AdaptationState state = after_ten_minutes(luminance);
    EXPECT_NEAR(state.rod_bleached, rods, 1e-6) << luminance;
    EXPECT_NEAR(state.cone_bleached, cones, 1e-6) << luminance;
  }
}

struct Exposures {
  double before, scene;
  std::array<double, 6> e;
};

TEST(DarkAdaptation, scenes_come_back_as_the_table_has_it) {
  constexpr std::array<double, 6> seconds = {1, 10, 60, 300, 600, 1200};
  constexpr std::array<Exposures, 5> rows = {
      {{1000, 0.1, {0.80661, 0.86960, 0.98010, 1, 1, 1}},
       {1000, 0.01, {0.52149, 0.60667, 0.79388, 0.83716, 0.97892, 0.99730}},
       {1000, 0.001, {0.05806, 0.06871, 0.09344, 0.34158, 0.82410, 0.97388}},
       {1000, 1e-4, {0.00639, 0.00758, 0.01035, 0.05348, 0.33786, 0.80242}},
       {3000, 0.001, {0.01439, 0.02000, 0.06452, 0.09902, 0.36698, 0.94662}}}};
  double worst = 0;
  for (const Exposures& row : rows)
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      const AdaptationState state = state_after(after_ten_minutes(row.before), row.scene, seconds[i]);
      worst = std::max(worst, std::abs(thresholds_of(state, row.scene).exposure - row.e[i]));
    }
  std::printf("exposure: worst difference from the table %.2g\n", worst);
  EXPECT_LE(worst, 6e-6);
}

TEST(DarkAdaptation, bleached_rods_see_as_rods_in_more_light) {
  const AdaptationState state = state_after(after_ten_minutes(10000), 0.01, 300);
  const double l_r = thresholds_of(state, 0.01).rod_luminance;
  EXPECT_NEAR(l_r, 0.237242, 1e-6);
  EXPECT_NEAR(mesopic_coefficient(l_r + 0.01), 0.60334, 1e-5);
  EXPECT_NEAR(mesopic_coefficient(0.02), 0.28099, 1e-5);
}

TEST(DarkAdaptation, the_slow_product_follows_its_own_exponential) {
  // The luminance of 11 000 scotopic trolands is found by bisection, as the pupil depends on it.
  double low = 1, high = 1e5;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (sp_ratio_d65 * middle * trolands_per_luminance(middle) < 11000 ? low : high) = middle;
  }
  AdaptationState state;
  state.rod_product = 0.5;
  EXPECT_NEAR(state_after(state, low, 60).rod_product, 0.46736682699656, 1e-13);
}

// Pattanaik et al. 2000: after their time constants a 1/e of the way is left.
TEST(DarkAdaptation, nerves_of_rods_and_cones_follow_light_each_in_its_own_time) {
  const AdaptationState before = {0, 0, 0, 3, 5};
  EXPECT_NEAR(state_after(before, 1, 0.15).rod_neural, 1 + 2 * std::exp(-1.0), 1e-14);
  EXPECT_NEAR(state_after(before, 1, 0.08).cone_neural, 1 + 4 * std::exp(-1.0), 1e-14);
}

// Out of the dark nothing is bleached yet: that makes rods no more sensitive than La has them.
TEST(DarkAdaptation, less_bleaching_than_light_keeps_up_counts_as_none) {
  for (const double luminance : {1.0, 1e3, 1e5}) {
    const AdaptationThresholds t = thresholds_of({0, 0, 0, luminance, luminance}, luminance);
    EXPECT_EQ(t.rod_luminance, luminance);
    EXPECT_EQ(t.cone_luminance, luminance);
    EXPECT_EQ(t.exposure, 1);
  }
}

TEST(DarkAdaptation, between_frames_the_eye_is_in_the_mean_of_their_light) {
  const AdaptationState first = adapted_state(0.1);
  const auto states = track_states(first, std::array{1.0, 100.0, 20.0}, 24);
  ASSERT_EQ(states.size(), 3u);
  EXPECT_EQ(states[0], first);
  EXPECT_EQ(states[1], state_after(first, 50.5, 1.0 / 24));
  EXPECT_EQ(states[2], state_after(states[1], 60, 1.0 / 24));
}

TEST(DarkAdaptation, frames_add_up_to_one_step) {
  double worst = 0;
  for (const double luminance : {0.0, 1e-4, 0.01, 1.0, 100.0, 1e4})
    for (const AdaptationState& from : {fully_bleached(), after_ten_minutes(1000), adapted_state(0.01)}) {
      AdaptationState frames = from;
      for (int i = 0; i < 14400; ++i) frames = state_after(frames, luminance, 1.0 / 24);
      const AdaptationState one = state_after(from, luminance, 600);
      worst = std::max({worst, std::abs(frames.rod_bleached - one.rod_bleached),
                        std::abs(frames.rod_product - one.rod_product),
                        std::abs(frames.cone_bleached - one.cone_bleached)});
    }
  std::printf("14 400 steps of 1/24 s against one of 600 s: %.2g\n", worst);
  EXPECT_LE(worst, 1e-9);
}

TEST(DarkAdaptation, who_is_adapted_stays_so_to_the_bit) {
  for (const double luminance : {0.0, 1e-5, 0.013, 0.7, 5.0, 1234.5, 1e6}) {
    const AdaptationState state = adapted_state(luminance);
    EXPECT_EQ(state_after(state, luminance, 1.0 / 24), state) << luminance;
    const AdaptationThresholds t = thresholds_of(state, luminance);
    EXPECT_EQ(t.rod_luminance, luminance);
    EXPECT_EQ(t.cone_luminance, luminance);
    EXPECT_EQ(t.exposure, 1);
    EXPECT_FALSE(adaptation_is_called_for(t, luminance));
  }
}

TEST(DarkAdaptation, the_dark_dims_and_the_light_dazzles) {
  const AdaptationState lit = adapted_state(100);
  EXPECT_LT(thresholds_of(lit, 0.001).exposure, 1e-3);
  EXPECT_TRUE(adaptation_is_called_for(thresholds_of(lit, 0.001), 0.001));
  const AdaptationState dark = adapted_state(0.001);
  EXPECT_EQ(thresholds_of(dark, 1000).exposure, 100);
  EXPECT_NEAR(thresholds_of(state_after(dark, 1000, 2), 1000).exposure, 1, 0.01);
}

TEST(DarkAdaptation, a_shot_in_pieces_has_the_bits_of_the_whole) {
  std::vector<double> luminances;
  for (int i = 0; i < 96; ++i) luminances.push_back(0.01 * std::pow(1.1, i % 24));
  const AdaptationState first = after_ten_minutes(1000);
  const std::vector<AdaptationState> whole = track_states(first, luminances, 24);
  ASSERT_EQ(whole.size(), luminances.size());
  EXPECT_EQ(whole.front(), first);
  for (const std::size_t chunks : {3u, 24u})
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      const std::size_t end = luminances.size() / chunks * (chunk + 1);
      EXPECT_EQ(track_states(first, std::span(luminances).first(end), 24).back(), whole[end - 1]);
    }
}

TEST(AdaptationHistory, is_read_as_it_is_written) {
  using Periods = std::vector<AdaptationPeriod>;
  const struct {
    const char* text;
    Periods periods;
  } rows[] = {{"1000:600", {{1000, 600}}},
              {"1e3:600,0.01:30", {{1000, 600}, {0.01, 30}}},
              {" 300 : 5 , moon:10,", {{300, 5}, {0.01, 10}}},
              {"# lit garage\n1000:600 # ten minutes\r\n\nmoon:0.5\n", {{1000, 600}, {0.01, 0.5}}},
              {"0:0", {{0, 0}}}};
  for (const auto& row : rows) {
    const AdaptationHistory history = parse_adaptation_history(row.text);
    EXPECT_EQ(history.problem, "") << row.text;
    EXPECT_EQ(history.periods, row.periods) << row.text;
  }
}

TEST(AdaptationHistory, what_is_wrong_is_named) {
  for (const char* text :
       {"", " ", "#", "1000", "1000:", ":600", "-1:600", "1000:-600", "nan:1", "1:inf", "1:2:3",
        "moonlight:600", "1000:600s", "1000;600", "1000:600,0.01", "0x10:1", "1,5:600"}) {
    const AdaptationHistory history = parse_adaptation_history(text);
    EXPECT_NE(history.problem, "") << text;
    EXPECT_TRUE(history.periods.empty()) << text;
  }
  EXPECT_NE(parse_adaptation_history("1000:600,lamp:3").problem.find("'lamp:3'"), std::string::npos);
}

}  // namespace
}  // namespace scotopic

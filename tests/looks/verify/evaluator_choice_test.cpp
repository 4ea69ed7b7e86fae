#include "looks/verify/evaluator_choice.h"

#include <gtest/gtest.h>

#include "support/primaries.h"

namespace scotopic {
namespace {

constexpr MeasuredEvaluator measured[] = {
    {"float", 1e-5, 5}, {"double", 5e-6, 15}, {"lut17", 1.5, 2}, {"lut33", 0.6, 3}, {"lut65", 0.2, 50}};

std::string_view picked(const EvaluatorDemand& demand) {
  const auto at = pick_evaluator(measured, demand);
  return at ? measured[*at].name : "none";
}

TEST(EvaluatorChoice, is_the_cheapest_that_is_accurate_enough_or_the_most_accurate_that_is_cheap_enough) {
  struct Row {
    std::optional<double> max_error, budget;
    std::string_view expected;
  };
  const Row rows[] = {{2.0, {}, "lut17"},   {1.0, {}, "lut33"},   {0.6, {}, "lut33"}, {0.5, {}, "float"},
                      {1e-5, {}, "float"},  {9e-6, {}, "double"}, {1e-6, {}, "none"}, {{}, 100.0, "double"},
                      {{}, 15.0, "double"}, {{}, 14.0, "float"},  {{}, 4.0, "lut33"}, {{}, 2.5, "lut17"},
                      {{}, 1.0, "none"},    {1.0, 4.0, "lut33"},  {1.0, 2.5, "none"}, {0.01, 5.0, "float"},
                      {6e-6, 14.0, "none"}};
  for (const Row& row : rows)
    EXPECT_EQ(picked({row.max_error, row.budget}), row.expected)
        << row.max_error.value_or(-1) << ' ' << row.budget.value_or(-1);
}

AppearanceParameters night() {
  AppearanceParameters p;
  p.adaptation = 0.01;
  p.white_luminance = 0.05;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return p;
}

TEST(EvaluatorChoice, what_is_picked_holds_its_bound_and_works) {
  // Between float's error and double's; no LUT comes near.
  const EvaluatorChoice choice = choose_evaluator(night(), {1e-3, {}}, true);
  ASSERT_TRUE(choice.picked);
  EXPECT_LE(choice.measured[*choice.picked].max_error, 1e-3);
  EXPECT_GE(choice.measured.size(), 3u);
  float r = 0.1f, g = 0.2f, b = 0.05f;
  PixelRows rows;
  rows.r = &r, rows.g = &g, rows.b = &b, rows.count = 1;
  choice.apply(rows, nullptr);
  EXPECT_NE(r, 0.1f);
}

TEST(EvaluatorChoice, without_luts_there_are_two_and_an_impossible_demand_picks_none) {
  const EvaluatorChoice choice = choose_evaluator(night(), {0.0, {}}, false);
  EXPECT_FALSE(choice.picked);
  EXPECT_EQ(choice.measured.size(), 2u);
}

}  // namespace
}  // namespace scotopic

#include "adaptation/thresholds.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace scotopic {
namespace {

struct StopsRow {
  double adaptation, ward1997, hdrvdp2;
};

// Computed in double from the published formulas, apart from this code, and rounded to the thousandth.
constexpr std::array<StopsRow, 9> stops_table = {{{10, -0.343, -0.047},
                                                  {3, -1.222, -0.350},
                                                  {1, -2.211, -0.915},
                                                  {0.3, -2.253, -1.665},
                                                  {0.1, -2.253, -2.374},
                                                  {0.03, -2.325, -3.156},
                                                  {0.01, -2.695, -3.869},
                                                  {0.003, -3.451, -4.651},
                                                  {0.001, -4.445, -5.364}}};

TEST(VisibilityStops, are_the_published_rules_values) {
  for (const StopsRow& row : stops_table) {
    EXPECT_NEAR(visibility_stops(row.adaptation, VisibilityRule::ward1997), row.ward1997, 6e-4)
        << row.adaptation;
    EXPECT_NEAR(visibility_stops(row.adaptation, VisibilityRule::hdrvdp2), row.hdrvdp2, 6e-4)
        << row.adaptation;
  }
}

TEST(VisibilityStops, never_brighten_and_are_zero_by_day) {
  for (const VisibilityRule rule : {VisibilityRule::ward1997, VisibilityRule::hdrvdp2})
    for (const double la : {18.0, 30.0, 100.0, 1e4, 1e8}) EXPECT_EQ(visibility_stops(la, rule), 0) << la;
}

TEST(VisibilityStops, fall_with_the_light_and_do_not_jump) {
  for (const VisibilityRule rule : {VisibilityRule::ward1997, VisibilityRule::hdrvdp2}) {
    double before = 0;
    for (double l = 2; l > -6; l -= 1e-3) {
      const double stops = visibility_stops(std::pow(10.0, l), rule);
      EXPECT_LE(stops, before + 0.0025) << l;
      EXPECT_LE(before - stops, 0.0085) << l;
      before = stops;
    }
  }
}

}  // namespace
}  // namespace scotopic

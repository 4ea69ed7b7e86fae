// Pigment against numbers made apart from this code, and against the differential equation itself.
#include "adaptation/time/bleaching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace scotopic {
namespace {

struct Step {
  const Pigment& pigment;
  double bleached, trolands, seconds, after;
};

// In double, from the closed form solved by other means, to 14 digits.
const Step steps[] = {
    {rod_pigment, 0.5, 11000, 60, 0.45655738149912}, {rod_pigment, 0.5, 0, 60, 0.42294778763335},
    {rod_pigment, 1, 0, 600, 0.20840936339838},      {rod_pigment, 0, 1e5, 10, 0.09193779251171},
    {cone_pigment, 0.5, 4000, 10, 0.45411122105480}, {cone_pigment, 1, 0, 60, 0.61668075936344}};

TEST(Bleaching, steps_end_where_the_closed_form_says) {
  double worst = 0;
  for (const Step& s : steps)
    worst = std::max(worst, std::abs(bleached_after(s.pigment, s.bleached, s.trolands, s.seconds) - s.after));
  worst = std::max(worst, std::abs(bleached_at_equilibrium(rod_pigment, 11000) - 0.18818373972769));
  worst = std::max(worst, std::abs(bleached_at_equilibrium(cone_pigment, 4000) - 0.06132477258361));
  std::printf("bleaching: worst difference %.2g\n", worst);
  EXPECT_LE(worst, 1e-13);
}

// Classical Runge-Kutta in long double: error of the order of (dt V/K)^4.
long double integrated(const Pigment& p, long double b, long double trolands, long double seconds) {
  constexpr int count = 20000;
  const long double h = seconds / count;
  const auto rate = [&](long double x) {
    return trolands * (1 - x) / p.bleaching - p.regeneration * x / (x + p.half_rate);
  };
  for (int i = 0; i < count; ++i) {
    const long double k1 = rate(b), k2 = rate(b + h / 2 * k1), k3 = rate(b + h / 2 * k2),
                      k4 = rate(b + h * k3);
    b += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return b;
}

TEST(Bleaching, is_the_solution_of_the_differential_equation) {
  double worst = 0;
  for (const Pigment& pigment : {rod_pigment, cone_pigment})
    for (const double from : {0.0, 1e-6, 0.03, 0.5, 0.99, 1.0})
      for (const double light : {0.0, 1e-6, 1e-2, 10.0, 4000.0, 1e5, 1e6})
        for (const double seconds : {1.0 / 24, 1.0, 60.0, 300.0}) {
          const long double exact = integrated(pigment, from, light, seconds);
          const double got = bleached_after(pigment, from, light, seconds);
          worst = std::max(worst, static_cast<double>(std::abs(got - exact)));
        }
  std::printf("bleaching: worst difference from Runge-Kutta %.2g\n", worst);
  EXPECT_LE(worst, 2e-15);
}

TEST(Bleaching, the_equivalent_background_decays_exponentially_in_darkness) {
  EXPECT_NEAR(equivalent_background(rod_pigment, 0.5), 30.456235, 1e-6);
  EXPECT_NEAR(equivalent_background(rod_pigment, 0.1), 0.824361, 1e-6);
  const double constant = rod_pigment.half_rate / rod_pigment.regeneration;
  for (const double bleached : {1.0, 0.9, 0.3, 1e-3}) {
    const double x = equivalent_background(rod_pigment, bleached_after(rod_pigment, bleached, 0, 300));
    EXPECT_NEAR(x / (equivalent_background(rod_pigment, bleached) * std::exp(-300 / constant)), 1, 1e-14)
        << bleached;
  }
}

TEST(Bleaching, equilibrium_and_no_time_change_no_bit) {
  for (const double light : {0.0, 1e-100, 1e-20, 1e-9, 1e-3, 1.0, 1e3, 1e6, 1e12}) {
    const double b = bleached_at_equilibrium(rod_pigment, light);
    EXPECT_EQ(bleached_after(rod_pigment, b, light, 1.0 / 24), b) << light;
    EXPECT_EQ(bleached_after(rod_pigment, 0.37, light, 0), 0.37) << light;
  }
}

TEST(Bleaching, stays_between_where_it_was_and_equilibrium) {
  for (const double light : {0.0, 1e-17, 1e-9, 1e-2, 1e3, 1e7, 1e12})
    for (const double from : {0.0, 1e-12, 0.2, 1.0})
      for (const double seconds : {1e-9, 1.0 / 24, 60.0, 1e5, 1e9}) {
        const double goal = bleached_at_equilibrium(rod_pigment, light);
        const double got = bleached_after(rod_pigment, from, light, seconds);
        EXPECT_GE(got, std::min(from, goal) * (1 - 4e-16)) << light << " " << from << " " << seconds;
        EXPECT_LE(got, std::max(from, goal) * (1 + 4e-16)) << light << " " << from << " " << seconds;
      }
}

}  // namespace
}  // namespace scotopic

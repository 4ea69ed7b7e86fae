// What several receptor tests share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace scotopic::test {

/// Centres of bands, nm.
inline std::vector<double> evenly(double first, double step, std::size_t count) {
  std::vector<double> centres(count);
  for (std::size_t i = 0; i < count; ++i) centres[i] = first + step * static_cast<double>(i);
  return centres;
}

/// Collects |measured - expected| as a multiple of each row's tolerance; prints the worst and where it is.
class WorstError {
 public:
  void add(const std::string& where, double measured, double expected, double tolerance) {
    const double ratio = measured == expected ? 0.0 : std::abs(measured - expected) / tolerance;
    ++rows_;
    if (ratio <= worst_ && rows_ > 1) return;
    worst_ = std::isnan(ratio) ? HUGE_VAL : ratio;
    char text[200];
    std::snprintf(text, sizeof text, ": %.9g, expected %.9g, off by %.3g of %.3g", measured, expected,
                  std::abs(measured - expected), tolerance);
    where_ = where + text;
  }

  void expect_within(const char* what) const {
    std::printf("%s: worst of %d: %s\n", what, rows_, where_.c_str());
    EXPECT_GT(rows_, 0);
    EXPECT_LE(worst_, 1.0) << what << " " << where_;
  }

 private:
  double worst_ = 0.0;
  int rows_ = 0;
  std::string where_;
};

}  // namespace scotopic::test

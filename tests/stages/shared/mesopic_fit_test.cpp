#include "stages/shared/mesopic_fit.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace scotopic {
namespace {

template <std::size_t Degree>
double worst_error() {
  const MesopicFit<Degree> fit;
  double worst = 0, where = 0;
  for (int i = 0; i <= 20000; ++i) {
    const double v = i / 20000.0;
    double share = 0;
    for (std::size_t k = Degree + 1; k-- > 0;) share = share * v + fit.coefficient[k];
    share *= v;
    const double error = std::abs(1 - share - mesopic_coefficient(fit.high * std::exp2(-fit.octaves * v)));
    if (error > worst) worst = error, where = v;
  }
  std::printf("degree %zu: worst error of 1 - m %.3g at v = %.4f\n", Degree, worst, where);
  return worst;
}

TEST(MesopicFit, polynomials_keep_their_stated_bounds) {
  EXPECT_LE(worst_error<7>(), 2e-8);
  EXPECT_LE(worst_error<17>(), 1e-14);
}

}  // namespace
}  // namespace scotopic

// The filter against a second writing in double (judge.h), over random pictures with lamps, black and holes.
#include "stages/contrast/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace scotopic {
namespace {

using test::Picture;

Picture random_picture(unsigned seed, int width, int height, int holes) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return std::ldexp(static_cast<double>(random()), -32); };
  Picture p(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool lamp = std::hypot(x - width / 2, y - height / 3) < 3;
      const double shape = std::exp(2.0 * std::sin(0.1 * x) + 1.5 * (uniform() + uniform() - 1.0));
      p.grey(x, y, lamp ? 1e4 : 0.18 * shape);
      p.planes[0][p.at(x, y)] *= static_cast<float>(2 * uniform());
      if (uniform() < 0.01) p.grey(x, y, uniform() < 0.5 ? 0.0 : -0.001);
    }
  for (int i = 0; i < holes; ++i)
    p.planes[i % 3][static_cast<std::size_t>(uniform() * width * height)] =
        i % 2 ? std::nanf("") : std::numeric_limits<float>::infinity();
  return p;
}

struct Agreement {
  double worst = 0, squares = 0, count = 0, change = 0;
  int x = 0, y = 0;
};

Agreement agreement(const ContrastParameters& p, const Picture& in) {
  Agreement a;
  const Picture out = test::filtered(p, in);
  for (int k = 0; k < 3; ++k) {
    const std::vector<double> expected = test::judged(p, in, k);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (!test::judge::operable(in, i)) continue;
      // Relative to the pixel, and to a thousandth of La where it is darker.
      const double scale = std::abs(expected[i]) + 1e-3 * p.adaptation / p.unit;
      const double error = std::abs(static_cast<double>(out.planes[k][i]) - expected[i]) / scale;
      if (!(error <= a.worst))
        a = {error,
             a.squares,
             a.count,
             a.change,
             static_cast<int>(i) % in.width,
             static_cast<int>(i) / in.width};
      a.squares += error * error;
      ++a.count;
      a.change = std::max(a.change, std::abs(expected[i] - static_cast<double>(in.planes[k][i])) / scale);
    }
  }
  return a;
}

// Where thresholds bend at their limit, the table's straight pieces are off by up to 4e-3 decades: 1 %.
TEST(ContrastJudge, agrees_on_random_pictures) {
  unsigned seed = 1;
  for (double ppd : {9.0, 16.0, 20.0, 40.0, 64.0})
    for (double adaptation : {1.0, 0.1, 0.01, 0.001})
      for (int holes : {0, 20}) {
        ContrastParameters p;
        p.pixels_per_degree = ppd;
        p.adaptation = adaptation;
        p.unit = adaptation / 0.18;
        p.display = {100, 100};
        const Picture in = random_picture(seed++, 61, 47, holes);
        const Agreement a = agreement(p, in);
        const double rms = std::sqrt(a.squares / a.count);
        std::printf("  ppd %2.0f La %5.3f holes %2d: worst %.1e at (%d, %d), rms %.1e; change up to %.2f\n",
                    ppd, adaptation, holes, a.worst, a.x, a.y, rms, a.change);
        EXPECT_LT(rms, 5e-4);
        EXPECT_LT(a.worst, ppd <= 20.0 && adaptation >= 0.1 ? 1e-5 : 0.015);
      }
}

}  // namespace
}  // namespace scotopic

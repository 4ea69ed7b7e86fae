#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "acuity/scenes.h"

namespace scotopic {
namespace {

using test::Image;

struct Agreement {
  double psnr = 0.0;  // dB, of CIELAB, 100 units full scale
  double worst = 0.0;
  int x = 0, y = 0;
};

Agreement agreement(const AcuityParameters& p, const Image& in, int step) {
  const Image out = test::filtered(p, in);
  Agreement result;
  double squares = 0.0;
  int count = 0;
  for (int y = 0; y < in.height; y += step) {
    for (int x = y % step; x < in.width; x += step) {
      Vec3<double> wanted = test::brute_force(p, in, x, y);
      if (p.space == AcuitySpace::light) wanted = test::cielab(p, wanted);
      const Vec3<double> found = test::cielab(p, test::pixel(out, x, y));
      double square = 0.0;
      for (std::size_t k = 0; k < 3; ++k) square += (found[k] - wanted[k]) * (found[k] - wanted[k]);
      squares += square / 3.0;
      ++count;
      if (!(std::sqrt(square) <= result.worst)) result = {0.0, std::sqrt(square), x, y};
    }
  }
  result.psnr = 10.0 * std::log10(1e4 / (squares / count + 1e-12));
  return result;
}

struct Case {
  double sigma, range_sigma;
  AcuityEngine engine;
  AcuityQuality quality;
  double least_psnr;
};

class Accuracy : public testing::TestWithParam<AcuitySpace> {};

TEST_P(Accuracy, agrees_with_brute_force_in_double) {
  using enum AcuityEngine;
  using enum AcuityQuality;
  // The engines' own bounds on an image meant to be hard: every channel has its own grain, lamps are 1e4
  // bright.
  const Case cases[] = {
      {1.0, 15, window, fine, 90},   {2.1, 15, window, fine, 90},      {4, 5, window, fine, 90},
      {2.1, 15, window, normal, 66}, {4, 15, window, normal, 66},      {4, 5, window, normal, 66},
      {4, 15, cells, normal, 58},    {4, 5, cells, normal, 62},        {8, 15, cells, normal, 54},
      {16, 15, cells, normal, 52},   {16, 5, cells, normal, 58},       {48, 15, cells, normal, 50},
      {48, 5, cells, normal, 52},    {16, 15, cells, fine, 65},        {48, 15, cells, fine, 62},
      {8, 15, cells, draft, 45},     {2.1, 15, automatic, normal, 66}, {3.7, 15, automatic, normal, 58},
  };
  const Image image = test::night(123, 97);
  for (const Case& c : cases) {
    AcuityParameters p = test::parameters(c.sigma, c.range_sigma);
    p.space = GetParam();
    p.engine = c.engine;
    p.quality = c.quality;
    const Agreement a = agreement(p, image, 5);
    std::printf("  sigma %4.1f range %2.0f %s %s: %.1f dB, worst %.3f CIELAB at (%d, %d)\n", c.sigma,
                c.range_sigma, AcuityFilter(p).engine() == window ? "window" : "cells",
                c.quality == fine    ? "fine"
                : c.quality == draft ? "draft"
                                     : "normal",
                a.psnr, a.worst, a.x, a.y);
    EXPECT_GE(a.psnr, c.least_psnr) << "sigma " << c.sigma << " range " << c.range_sigma;
  }
}

INSTANTIATE_TEST_SUITE_P(Spaces, Accuracy, testing::Values(AcuitySpace::light, AcuitySpace::lab),
                         [](const auto& space) {
                           return space.param == AcuitySpace::light ? "light" : "lab";
                         });

}  // namespace
}  // namespace scotopic

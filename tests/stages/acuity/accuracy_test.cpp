#include <gtest/gtest.h>

#include <cstdio>

#include "stages/acuity/scenes.h"

namespace scotopic {
namespace {

using test::Image;

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
      {4, 15, cells, normal, 60},    {4, 5, cells, normal, 66},        {8, 15, cells, normal, 60},
      {16, 15, cells, normal, 58},   {16, 5, cells, normal, 70},       {48, 15, cells, normal, 50},
      {48, 5, cells, normal, 68},    {16, 15, cells, fine, 72},        {48, 15, cells, fine, 70},
      {8, 15, cells, draft, 52},     {2.1, 15, automatic, normal, 66}, {3.7, 15, automatic, normal, 58},
  };
  const Image image = test::night(123, 97);
  for (const Case& c : cases) {
    AcuityParameters p = test::parameters(c.sigma, c.range_sigma);
    p.space = GetParam();
    p.engine = c.engine;
    p.quality = c.quality;
    const test::Agreement a = test::agreement(p, image, 5);
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

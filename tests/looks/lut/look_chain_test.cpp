#include "looks/lut/look_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "stages/shared/colour_difference.h"
#include "stages/reference.h"
#include "looks/verify/measure.h"
#include "looks/chain/ocio_chain.h"
#include "looks/lut/processor.h"
#include "looks/support.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

using test::adapted_to;
using test::processor_of;

OCIO::ConstCPUProcessorRcPtr look(const AppearanceParameters& p, std::size_t edge = 33) {
  return processor_of(look_chain(p, edge));
}

Vec3<double> through(const OCIO::ConstCPUProcessorRcPtr& processor, const Vec3<double>& rgb) {
  float pixel[3] = {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
  processor->applyRGB(pixel);
  return {pixel[0], pixel[1], pixel[2]};
}

struct Target {
  const char* working;
  const char* colours;
  double adaptation;
  std::size_t edge;
  double mean, p99, max;
};

// The project's targets are .12/.6/1.8 (33), .03/.15/.6 (65), .06/.5/2 (65, ACEScg); these are half of them.
const Target targets[] = {
    {"rec709", "rec709", 0.01, 33, 0.06, 0.30, 0.9},   {"rec709", "rec709", 0.1, 33, 0.06, 0.30, 0.9},
    {"rec709", "rec709", 0.01, 65, 0.015, 0.075, 0.3}, {"rec709", "rec709", 0.1, 65, 0.015, 0.075, 0.3},
    {"rec709", "ap1", 0.01, 65, 0.03, 0.25, 1.0},      {"rec709", "ap1", 0.1, 65, 0.03, 0.25, 1.0},
    {"ap1", "ap1", 0.01, 65, 0.03, 0.25, 1.0},         {"ap1", "ap1", 0.1, 65, 0.03, 0.25, 1.0},
};

TEST(LookChain, error_stays_below_half_of_the_targets) {
  for (const Target& t : targets) {
    const AppearanceParameters p = adapted_to(t.adaptation, t.working);
    const BakeError e = measure_bake(p, look(p, t.edge), gamut_xyz_matrix(t.colours).value());
    std::printf(
        "%-6s working, %-6s colours, La %-4g %zu: mean %.4f 99 %% %.4f max %.4f at (%.4g, %.4g, %.4g)\n",
        t.working, t.colours, t.adaptation, t.edge, e.mean, e.p99, e.max, e.worst[0], e.worst[1], e.worst[2]);
    EXPECT_EQ(e.samples + e.outside, 100000u);
    EXPECT_LT(e.outside, 100u);
    EXPECT_LE(e.mean, t.mean);
    EXPECT_LE(e.p99, t.p99);
    EXPECT_LE(e.max, t.max);
  }
}

TEST(LookChain, error_falls_with_the_square_of_the_edge) {
  for (const double la : {0.01, 0.1}) {
    const AppearanceParameters p = adapted_to(la);
    const double coarse = measure_bake(p, look(p, 33), p.xyz_from_rgb, 30000).mean;
    const double fine = measure_bake(p, look(p, 65), p.xyz_from_rgb, 30000).mean;
    std::printf("La %g: 33 to 65 nodes, mean error falls %.2f times\n", la, coarse / fine);
    EXPECT_GE(coarse / fine, 3.5);
  }
}

TEST(LookChain, every_number_in_gives_a_finite_one_out_and_alpha_keeps_its_bits) {
  for (const Model model : {Model::filament2021, Model::kirk2011, Model::cao2008})
    for (const double la : {0.001, 0.1, 3.0}) {
      const OddPixels odd = odd_pixels(look(adapted_to(la, "rec709", model)));
      EXPECT_EQ(odd.tested, 2197u);
      EXPECT_EQ(odd.not_finite, 0u);
      EXPECT_EQ(odd.alpha_changed, 0u);
      EXPECT_TRUE(odd.black_stays_black);
    }
}

TEST(LookChain, below_its_range_what_is_proportional_to_light_stays_so) {
  const AppearanceParameters p = adapted_to(0.01);
  const auto processor = look(p);
  const AppearanceReference exact(p);
  double worst = 0;
  for (const Vec3<double>& colour : {Vec3<double>{1, 1, 1}, {1, .2, .1}, {.1, .3, 1}})
    for (double scale = 0x1p-20; scale > 0x1p-40; scale /= 8) {
      const Vec3<double> in = {scale * colour[0], scale * colour[1], scale * colour[2]};
      const double d =
          exposed_difference(p.xyz_from_rgb * exact({in}), p.xyz_from_rgb * through(processor, in));
      worst = std::max(worst, d);
      EXPECT_LE(d, 0.5) << scale;
    }
  std::printf("worst from 2^-20 down to 2^-40 of white: %.3f\n", worst);
}

TEST(LookChain, light_above_the_mesopic_range_passes_to_a_thousandth) {
  const auto processor = look(adapted_to(0.1));
  double worst = 0;
  // From 100 times the photopic limit to half's largest, where white is .56 cd/m2.
  for (double level = 900; level < 65504; level *= 1.37)
    for (const Vec3<double>& colour : {Vec3<double>{1, 1, 1}, {1, .5, .2}, {.3, .5, 1}, {.2, 1, .2}})
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3<double> in = {level * colour[0], level * colour[1], level * colour[2]};
        worst = std::max(worst, std::abs(through(processor, in)[i] - in[i]) / level);
      }
  std::printf("photopic pixels change by at most %.2g of their largest component\n", worst);
  EXPECT_LE(worst, 1e-3);
}

TEST(LookChain, colours_that_ap1_does_not_hold_are_bounded_and_continuous) {
  const auto processor = look(adapted_to(0.05));
  // From grey straight out of every gamut, in small steps.
  for (const Vec3<double>& direction :
       {Vec3<double>{1, -1, 0}, {-1, 1, 0}, {0, -1, 1}, {-.4, -.4, 1}, {1, 1, -1}})
    for (const double level : {0x1p-16, 0x1p-4, 16.0}) {
      Vec3<double> last{};
      const int steps = 4000;
      for (int i = 0; i <= steps; ++i) {
        const double far = 4.0 * i / steps;
        Vec3<double> in;
        for (std::size_t c = 0; c < 3; ++c) in[c] = level * (1 + far * direction[c]);
        const Vec3<double> out = through(processor, in);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_LE(std::abs(out[c]), 16 * level);
          const double step = i > 0 ? std::abs(out[c] - last[c]) : 0;
          ASSERT_LE(step, 0.05 * level) << far;
        }
        last = out;
      }
    }
}

TEST(LookChain, the_3d_part_does_not_depend_on_the_unit) {
  AppearanceParameters p = adapted_to(0.1);
  const auto core = [](const AppearanceParameters& q) {
    return std::get<Lut3DStep>(look_chain(q, 17).steps[7]);
  };
  const Lut3DStep one = core(p);
  p.white_luminance = 20;
  const Lut3DStep other = core(p);
  double worst = 0;
  for (std::size_t i = 0; i < one.values.size(); ++i)
    worst = std::max(worst, std::abs(one.values[i] - other.values[i]));
  std::printf("largest difference of a node %.2g\n", worst);
  // Digits that files hold; nodes pass through float RGB in different units.
  EXPECT_LE(worst, 2e-6);
  // Of the adaptation luminance it is a function: no one LUT serves all looks.
  p.adaptation = 0.01;
  const Lut3DStep darker = core(p);
  double difference = 0;
  for (std::size_t i = 0; i < one.values.size(); ++i)
    difference = std::max(difference, std::abs(one.values[i] - darker.values[i]));
  EXPECT_GT(difference, 0.02);
}

}  // namespace
}  // namespace scotopic

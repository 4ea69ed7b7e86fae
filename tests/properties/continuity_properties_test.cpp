// How far a result moves when something moves a little: a stated slope, whatever threshold lies between.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "properties/judge.h"
#include "properties/pixels.h"
#include "properties/property.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

TEST(OperatorProperties, each_strength_alone_is_continuous_from_0_on) {
  // One strength steps, the others stay. Per unit of strength a pixel moves by at most 80 times its size: a
  // shift is up to 30 times a dark pixel's light, and its luminance follows. In float, that and its own
  // rounding, twice.
  constexpr double Strengths::*strengths[] = {&Strengths::all, &Strengths::shift, &Strengths::luminance,
                                              &Strengths::chroma};
  constexpr const char* names[] = {"all", "shift", "luminance", "chroma"};
  constexpr double slope = 80, rounding = 2 * 8e-6;
  double steepest[4] = {}, roughest = 0;
  for_all(
      cases({Regime::huge, Regime::subnormal}),
      [&](Case c, Coverage& coverage) {
        RC_PRE(c.parameters.model != Model::safko2019 && is_light(c));
        c.planes = Planes::rgb;
        Random random(bits(c.sample.rgb)[1]);
        const auto k = static_cast<std::size_t>(random.below(4));
        if (k) c.parameters.strength.all = random.uniform(0.1, 1);
        double& strength = c.parameters.strength.*strengths[k];
        strength = random.chance(0.5) ? 0 : random.uniform(0, 1);
        Case other = c;
        const double step = random.log_uniform(1e-9, 0.5);
        other.parameters.strength.*strengths[k] += strength + step <= 1 ? step : -step;
        const auto pixel = c.sample.widened(c.planes);
        const auto a = AppearanceReference(c.parameters)(pixel),
                   b = AppearanceReference(other.parameters)(pixel);
        const double size = std::max({largest(c.sample.rgb), largest(a), largest(b)}),
                     moved = distance(a, b) / size;
        const std::string kind = names[k];
        coverage(kind + " moved", moved > 0);
        coverage(kind + " moved from 0", moved > 0 && strength == 0);
        steepest[k] = std::max(steepest[k], (moved - 1e-13) / step);
        RC_ASSERT(moved <= slope * step + 1e-13);
        const auto narrow = [](const Case& x) {
          const auto out = applied(AppearanceBatch(x.parameters), x);
          return Vec3<double>{out[0], out[1], out[2]};
        };
        const double moved_narrow = distance(narrow(c), narrow(other)) / std::max(size, 0x1p-120);
        coverage(kind + " moved from 0 in float", moved_narrow > 0 && strength == 0);
        roughest = std::max(roughest, moved_narrow - slope * step);
        RC_ASSERT(moved_narrow <= slope * step + rounding);
      },
      [&] {
        Shares shares;
        for (const std::string kind : names) {
          shares.emplace_back(kind + " moved", 0.1);
          shares.emplace_back(kind + " moved from 0", 0.05);
          shares.emplace_back(kind + " moved from 0 in float", 0.03);
        }
        return shares;
      }());
  for (std::size_t k = 0; k < 4; ++k) std::printf("steepest in strength %s: %.3g\n", names[k], steepest[k]);
  std::printf("float beyond the slope: %.3g\n", roughest);
}

TEST(OperatorProperties, is_continuous_with_a_stated_slope) {
  // A step in RGB moves light by at most 600 times the step, wherever the step crosses: La = 5, .002, faces,
  // clamps. (At black the shift alone is 30 times; the weight, falling with Y, and the luminance add to it.)
  double steepest = 0;
  for_all(
      cases(no_light),
      [&](Case c, Coverage& coverage) {
        RC_PRE(c.parameters.model != Model::safko2019 && is_light(c));
        c.planes = Planes::rgb;
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        Random random(bits(c.sample.rgb)[1] + 3);
        const double step = largest(pixel.rgb) * random.log_uniform(1e-7, 0.3);
        ReferencePixel other = pixel;
        for (auto& x : other.rgb) x += step * random.uniform(-1, 1);
        const double moved = distance(op(pixel), op(other)), slope = moved / distance(pixel.rgb, other.rgb);
        steepest = std::max(steepest, slope);
        coverage("crossing 5", (local_luminance(op, pixel.rgb) < 5) != (local_luminance(op, other.rgb) < 5));
        coverage("crossing the gamut's face", *std::min_element(other.rgb.begin(), other.rgb.end()) < 0);
        RC_ASSERT(slope <= 600);
      },
      {{"crossing 5", 0.005}, {"crossing the gamut's face", 0.05}}, 40000);
  std::printf("steepest slope of light %.3g\n", steepest);
}

TEST(OperatorProperties, the_stated_slope_holds_on_both_sides_of_every_threshold) {
  // Two lights of one colour, one just below and one just above a local luminance at which a formula changes.
  constexpr double thresholds[] = {5, 4.998, 0.005, 0.00203, 0.001};
  constexpr const char* names[] = {"5", "4.998", ".005", ".00203", ".001"};
  double steepest[5] = {};
  for_all(
      cases(no_light),
      [&](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::kirk2011;
        c.planes = Planes::rgb;
        c.parameters.weight = Weight::local;
        Random random(bits(c.sample.rgb)[2] + 7);
        const auto k = static_cast<std::size_t>(random.below(5));
        c.parameters.adaptation = thresholds[k] * random.log_uniform(1e-3, 0.99);
        RC_PRE(is_light(c));
        const AppearanceReference op(c.parameters);
        ReferencePixel below = c.sample.widened(c.planes), above = below;
        const double room = (thresholds[k] - c.parameters.adaptation) / c.parameters.white_luminance /
                            luminance(op, below.rgb);
        const double gap = random.log_uniform(1e-12, 1e-2);
        for (std::size_t i = 0; i < 3; ++i) {
          above.rgb[i] = below.rgb[i] * room * (1 + gap * random.uniform(0.01, 1));
          below.rgb[i] *= room * (1 - gap * random.uniform(0.01, 1));
        }
        RC_PRE(largest(above.rgb) < 1e30);
        coverage(names[k], local_luminance(op, below.rgb) < thresholds[k] &&
                               local_luminance(op, above.rgb) > thresholds[k]);
        const double slope = distance(op(below), op(above)) / distance(below.rgb, above.rgb);
        const double rounding = 1e-12 * largest(above.rgb) / distance(below.rgb, above.rgb);
        steepest[k] = std::max(steepest[k], slope - rounding);
        RC_ASSERT(slope <= 80 + rounding);
      },
      {{"5", 0.15}, {"4.998", 0.15}, {".005", 0.15}, {".00203", 0.15}, {".001", 0.15}}, 20000);
  for (std::size_t k = 0; k < 5; ++k)
    std::printf("steepest slope around %s cd/m2: %.3g\n", names[k], steepest[k]);
}

TEST(OperatorProperties, is_continuous_in_the_adaptation_luminance) {
  // A relative step of La moves a light by at most 30 times that of its size.
  double steepest = 0;
  for_all(cases(no_light),
          [&](Case c, Coverage& coverage) {
            RC_PRE(c.parameters.model != Model::safko2019 && is_light(c));
            c.planes = Planes::rgb;
            Random random(bits(c.sample.rgb)[0] + 5);
            const double edges[] = {5, 4.998, 0.005, 0.002, 0.001, c.parameters.adaptation};
            const int edge = random.below(6);
            c.parameters.adaptation = edges[edge];
            Case other = c;
            const double step = random.log_uniform(1e-9, 1e-2);
            other.parameters.adaptation *= 1 - step;
            const auto pixel = c.sample.widened(c.planes);
            const auto a = AppearanceReference(c.parameters)(pixel),
                       b = AppearanceReference(other.parameters)(pixel);
            coverage("at 5", edge == 0);
            coverage("at .005", edge == 2);
            coverage("at the scotopic end", edge == 3 || edge == 4);
            const double moved = distance(a, b) / std::max(largest(a), largest(pixel.rgb));
            coverage("moved", moved > 0);
            steepest = std::max(steepest, (moved - 1e-13) / step);
            RC_ASSERT(moved <= 30 * step + 1e-13);
          },
          {{"at 5", 0.1}, {"at .005", 0.1}, {"at the scotopic end", 0.2}, {"moved", 0.5}});
  std::printf("steepest in a relative step of La: %.3g\n", steepest);
}

}  // namespace
}  // namespace scotopic::test

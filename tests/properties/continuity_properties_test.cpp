// How far a result moves when something moves a little: a stated slope, whatever threshold lies between.
#include <cmath>
#include <cstdio>

#include "properties/judge.h"
#include "properties/pixels.h"
#include "properties/property.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

TEST(OperatorProperties, strength_is_continuous) {
  // A step of the strengths moves a pixel by at most 300 times the step of its size: a shift is up to 30 times a dark
  // pixel's light, and its luminance follows.
  for_all(
      cases({Regime::huge, Regime::subnormal}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) return;
        if (!is_light(c)) return;
        c.planes = Planes::rgb;
        Case other = c;
        Random random(bits(c.sample.rgb)[1]);
        const double step = random.log_uniform(1e-9, 0.1);
        for (double* s : {&other.parameters.strength.all, &other.parameters.strength.shift,
                          &other.parameters.strength.luminance, &other.parameters.strength.chroma})
          *s = std::min(1.0, *s + step);
        const auto a = AppearanceReference(c.parameters)(c.sample.widened(c.planes));
        const auto b = AppearanceReference(other.parameters)(other.sample.widened(other.planes));
        coverage("light");
        RC_ASSERT(distance(a, b) <= 300 * step * std::max({largest(c.sample.rgb), largest(a), largest(b)}));
      },
      {{"light", 0.3}});
}

TEST(OperatorProperties, is_continuous_with_a_stated_slope) {
  // A step in RGB moves light by at most 500 times the step, wherever the step crosses: La = 5, .002, faces, clamps.
  // (At black the shift alone is 30 times; the weight, falling with Y, and the luminance add to it.)
  double steepest = 0;
  for_all(
      cases(no_light),
      [&](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) return;
        c.planes = Planes::rgb;
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        const auto pixel = c.sample.widened(c.planes);
        Random random(bits(c.sample.rgb)[1] + 3);
        const double step = largest(pixel.rgb) * random.log_uniform(1e-7, 0.3);
        ReferencePixel other = pixel;
        for (auto& x : other.rgb) x += step * random.uniform(-1, 1);
        const double moved = distance(op(pixel), op(other)), slope = moved / distance(pixel.rgb, other.rgb);
        steepest = std::max(steepest, slope);
        coverage("light");
        coverage("crossing 5", (local_luminance(op, pixel.rgb) < 5) != (local_luminance(op, other.rgb) < 5));
        coverage("crossing the gamut's face", *std::min_element(other.rgb.begin(), other.rgb.end()) < 0);
        RC_ASSERT(slope <= 500);
      },
      {{"light", 0.3}, {"crossing 5", 0.002}, {"crossing the gamut's face", 0.02}}, 40000);
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
        if (!is_light(c)) return;
        const AppearanceReference op(c.parameters);
        ReferencePixel below = c.sample.widened(c.planes), above = below;
        const double room = (thresholds[k] - c.parameters.adaptation) / c.parameters.white_luminance / luminance(op, below.rgb);
        const double gap = random.log_uniform(1e-12, 1e-2);
        for (std::size_t i = 0; i < 3; ++i) {
          above.rgb[i] = below.rgb[i] * room * (1 + gap * random.uniform(0.01, 1));
          below.rgb[i] *= room * (1 - gap * random.uniform(0.01, 1));
        }
        if (!(largest(above.rgb) < 1e30)) return;
        coverage(names[k], local_luminance(op, below.rgb) < thresholds[k] && local_luminance(op, above.rgb) > thresholds[k]);
        const double slope = distance(op(below), op(above)) / distance(below.rgb, above.rgb);
        const double rounding = 1e-12 * largest(above.rgb) / distance(below.rgb, above.rgb);
        steepest[k] = std::max(steepest[k], slope - rounding);
        RC_ASSERT(slope <= 500 + rounding);
      },
      {{"5", 0.05}, {"4.998", 0.05}, {".005", 0.05}, {".00203", 0.05}, {".001", 0.05}}, 20000);
  for (std::size_t k = 0; k < 5; ++k) std::printf("steepest slope around %s cd/m2: %.3g\n", names[k], steepest[k]);
}

TEST(OperatorProperties, is_continuous_in_the_adaptation_luminance) {
  for_all(
      cases(no_light),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) return;
        c.planes = Planes::rgb;
        if (!is_light(c)) return;
        Random random(bits(c.sample.rgb)[0] + 5);
        const double edges[] = {5, 4.998, 0.005, 0.002, 0.001, c.parameters.adaptation};
        const int edge = random.below(6);
        c.parameters.adaptation = edges[edge];
        Case other = c;
        const double step = random.log_uniform(1e-9, 1e-2);
        other.parameters.adaptation *= 1 - step;
        const auto pixel = c.sample.widened(c.planes);
        const auto a = AppearanceReference(c.parameters)(pixel), b = AppearanceReference(other.parameters)(pixel);
        coverage("at 5", edge == 0);
        coverage("at .005", edge == 2);
        coverage("at the scotopic end", edge == 3 || edge == 4);
        RC_ASSERT(distance(a, b) <= 100 * step * std::max(largest(a), largest(pixel.rgb)));
      },
      {{"at 5", 0.05}, {"at .005", 0.05}, {"at the scotopic end", 0.1}});
}

}  // namespace
}  // namespace scotopic::test

#include "scene/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "stages/acuity/cutoff.h"
#include "stages/shared/colour_difference.h"
#include "stages/reference.h"
#include "support/primaries.h"

namespace scotopic {
namespace {

struct Scene {
  std::vector<float> r, g, b;
  SceneStatistics measured(const AppearanceParameters& p) {
    SceneStatistics s;
    SceneMeter(p, r.size())
        .measure({r.data(), g.data(), b.data(), nullptr, nullptr, nullptr, nullptr, r.size()}, 0, s);
    return s;
  }
};

AppearanceParameters at(double adaptation) {
  AppearanceParameters request;
  request.adaptation = adaptation;
  request.white_luminance = adaptation / 0.18;
  request.xyz_from_rgb = test::rec709;
  request.xyz_from_gamut = test::rec709;
  return request;
}

TEST(Plan, effects_end_at_five_candelas) {
  const struct {
    double adaptation;
    bool needed;
  } rows[] = {{4.999, true}, {5, false}, {5.001, false}, {0.01, true}};
  for (const auto& row : rows) {
    const ScenePlan plan = plan_scene(at(row.adaptation), nullptr);
    for (const char* effect : {"shift", "luminance", "chroma"}) {
      EXPECT_EQ(plan.effect(effect).needed, row.needed) << row.adaptation << effect;
      EXPECT_EQ(plan.effect(effect).threshold, 5);
      EXPECT_FALSE(plan.effect(effect).reason.empty());
    }
    EXPECT_EQ(plan.nothing(), !row.needed);
  }
}

TEST(Plan, the_thesis_pipeline_is_never_skipped) {
  AppearanceParameters request = at(1000);
  request.model = Model::safko2019;
  const ScenePlan plan = plan_scene(request, nullptr);
  EXPECT_TRUE(plan.effect("shift").runs());
  EXPECT_FALSE(plan.effect("luminance").runs());
  EXPECT_FALSE(plan.nothing());
}

TEST(Plan, the_thesis_pipeline_is_off_when_it_is_not_asked_for) {
  AppearanceParameters request = at(0.01);
  request.model = Model::safko2019;
  request.strength.shift = 0;
  EXPECT_TRUE(plan_scene(request, nullptr).nothing());
}

TEST(Plan, a_dark_adapted_eye_that_sees_only_bright_pixels_needs_nothing) {
  AppearanceParameters request = at(0.01);
  request.white_luminance = 10;
  Scene bright{{1, 2}, {1, 2}, {1, 0.8f}};
  const SceneStatistics s = bright.measured(request);
  EXPECT_TRUE(plan_scene(request, &s).nothing());
  request.weight = Weight::global;
  EXPECT_FALSE(plan_scene(request, &s).nothing());
}

TEST(Plan, share_is_that_of_pixels_below_the_limit) {
  AppearanceParameters request = at(0.01);
  request.white_luminance = 10;
  Scene half{{1, 1, 0.01f, 0.01f}, {1, 1, 0.01f, 0.01f}, {1, 1, 0.01f, 0.01f}};
  const SceneStatistics s = half.measured(request);
  EXPECT_EQ(plan_scene(request, &s).effect("shift").share, 0.5);
}

TEST(Plan, a_grey_scene_keeps_photopic_luminance) {
  AppearanceParameters request = at(0.01);
  Scene grey{{0.1f, 0.5f}, {0.1f, 0.5f}, {0.1f, 0.5f}};
  const SceneStatistics s = grey.measured(request);
  const ScenePlan plan = plan_scene(request, &s);
  EXPECT_FALSE(plan.effect("luminance").needed);
  EXPECT_EQ(plan.parameters.luminance, LuminancePolicy::photopic);
  EXPECT_TRUE(plan.effect("shift").runs());
}

TEST(Plan, what_is_skipped_would_not_have_been_seen) {
  // Greys tinted by a little more and a little less than the tolerance, at every darkness.
  double worst = 0;
  int skipped = 0, kept = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  for (const double la : {4.999, 1.0, 0.1, 0.01, 0.001, 1e-4})
    for (const double tint : {0.0, 1e-3, 3e-3, 0.01, 0.02, 0.05}) {
      AppearanceParameters request = at(la);
      Scene scene;
      for (int i = 0; i < 200; ++i) {
        const double v = std::exp2(-10 * uniform(random));
        scene.r.push_back(static_cast<float>(v * (1 + tint * (uniform(random) - 0.5))));
        scene.g.push_back(static_cast<float>(v));
        scene.b.push_back(static_cast<float>(v * (1 + tint * (uniform(random) - 0.5))));
      }
      const SceneStatistics s = scene.measured(request);
      const ScenePlan plan = plan_scene(request, &s);
      ++(plan.effect("luminance").needed ? kept : skipped);
      const AppearanceReference all(request), planned(plan.parameters);
      for (std::size_t i = 0; i < scene.r.size(); ++i) {
        const ReferencePixel pixel{{scene.r[i], scene.g[i], scene.b[i]}, {}, {}};
        worst = std::max(worst, exposed_difference(test::rec709 * all(pixel), test::rec709 * planned(pixel)));
      }
    }
  std::printf("skipped %d, kept %d; worst dE00 of skipping %.3g\n", skipped, kept, worst);
  EXPECT_GT(skipped, 5);
  EXPECT_GT(kept, 5);
  EXPECT_LE(worst, 0.05);
}

TEST(Plan, five_percent_of_sp_ratio_would_have_been_seen) {
  // Why sp_tolerance is not .05: a colour of S/P 5 % off white's, mesopic against photopic luminance.
  AppearanceParameters request = at(0.001);
  auto photopic = request;
  photopic.luminance = LuminancePolicy::photopic;
  const ReferencePixel pixel{{0.1, 0.1, 0.1088}, {}, {}};
  const double difference = exposed_difference(test::rec709 * AppearanceReference(request)(pixel),
                                               test::rec709 * AppearanceReference(photopic)(pixel));
  std::printf("dE00 of a skipped 5 %%: %.3g\n", difference);
  EXPECT_GT(difference, 0.5);
}

TEST(Plan, what_the_user_switched_off_stays_off) {
  AppearanceParameters request = at(0.01);
  request.strength.chroma = 0;
  const ScenePlan plan = plan_scene(request, nullptr);
  EXPECT_FALSE(plan.effect("chroma").runs());
  EXPECT_TRUE(plan.effect("chroma").needed);
}

TEST(Plan, differences_name_the_effect_that_makes_them) {
  AppearanceParameters request = at(0.01);
  Scene colours{{0.3f, 0.05f}, {0.05f, 0.05f}, {0.02f, 0.4f}};
  const SceneStatistics s = colours.measured(request);
  const ScenePlan plan = plan_scene(request, &s);
  for (const char* effect : {"shift", "luminance", "chroma"})
    EXPECT_GT(plan.effect(effect).difference, 1) << effect;
}

}  // namespace
}  // namespace scotopic

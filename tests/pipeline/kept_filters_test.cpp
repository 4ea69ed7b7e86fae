// Filters that a host's tiles share: made once for a scene, and anew for another.
#include "pipeline/memory/kept_filters.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace scotopic {
namespace {

/// A filter that tells which it is by its halo.
class NumberedFilter : public SpatialFilter {
 public:
  explicit NumberedFilter(int number) : number_(number) {}
  int halo() const noexcept override { return number_; }
  void filter(const AcuityWindow& window, const AcuityTile& tile, const ParallelFor&) const override {
    copy_tile(window, tile);
  }

 private:
  int number_;
};

class CountingStage : public FilterStage {
 public:
  std::string_view name() const noexcept override { return "counting"; }
  EffectDecision decide(const StageScene&) const override { return {}; }
  std::vector<Attribute> stamps(const StageScene&) const override { return {}; }
  std::unique_ptr<SpatialFilter> make(const StageScene&, const Notes& notes) const override {
    notes.note("a note of the filter");
    return std::make_unique<NumberedFilter>(++made);
  }
  mutable std::atomic<int> made = 0;
};

class KeptFilters : public testing::Test {
 protected:
  int number(const StageScene& scene) const { return kept_.front()->make(scene, {})->halo(); }

  std::shared_ptr<const CountingStage> counting_ = std::make_shared<const CountingStage>();
  FilterStages kept_ = kept_filters({counting_});
};

TEST_F(KeptFilters, are_the_same_for_the_same_scene_and_new_for_another) {
  const std::vector<std::function<void(StageScene&)>> changes = {
      [](StageScene& s) { s.parameters.adaptation = 0.2; },
      [](StageScene& s) { s.parameters.white_luminance = 3; },
      [](StageScene& s) { s.parameters.rod_adaptation = 0.01; },
      [](StageScene& s) { s.resolution.pixels_per_degree = 30; },
      [](StageScene& s) { s.resolution.pixel_aspect = 2; },
      [](StageScene& s) { s.wraps = true; }};
  int expected = 0;
  for (const auto& change : changes) {
    const StageScene scene;
    StageScene other;
    change(other);
    ++expected;
    EXPECT_EQ(number(scene), expected);
    EXPECT_EQ(number(scene), expected);
    ++expected;
    EXPECT_EQ(number(other), expected);
    EXPECT_EQ(number(other), expected);
  }
  EXPECT_EQ(counting_->made, expected);
}

TEST_F(KeptFilters, of_an_eye_that_still_adapts_are_not_kept) {
  StageScene scene;
  scene.adapting.emplace();
  EXPECT_EQ(number(scene), 1);
  EXPECT_EQ(number(scene), 2);
}

TEST_F(KeptFilters, say_again_what_they_said) {
  std::vector<std::string> said;
  for (int i = 0; i < 2; ++i)
    (void)kept_.front()->make({}, {[&](const std::string& line) { said.push_back(line); }, nullptr});
  EXPECT_EQ(said, std::vector<std::string>(2, "a note of the filter"));
}

TEST_F(KeptFilters, threads_that_ask_at_once_get_one) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 100; ++k) EXPECT_EQ(number({}), 1);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(counting_->made, 1);
}

}  // namespace
}  // namespace scotopic

// Stages that look around, or at where and when a pixel is, on whole images.
#include "pipeline/stages/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>

#include "pipeline/rows/threads.h"
#include "pipeline/stage_runs.h"

namespace scotopic {
namespace {

using test::bits;
using test::picture;
using test::read_bits;
using test::run;
using test::settings;
using test::temporary;
using test::TestPart;
using test::write_exr;

/// A stage that counts what it is asked for, and changes nothing.
class Counting : public PointStage {
 public:
  explicit Counting(std::atomic<int>& memories) : memories_(memories) {}
  std::string_view name() const noexcept override { return "counting"; }
  EffectDecision decide(const StageScene&) const override {
    return {.effect = name(), .asked = true, .needed = true, .share = 1};
  }
  std::vector<Attribute> stamps(const StageScene&) const override { return {}; }
  std::unique_ptr<const RowStage> make(const StageScene&, const Notes&) const override {
    return std::make_unique<Rows>(memories_);
  }

 private:
  struct Rows : RowStage {
    explicit Rows(std::atomic<int>& m) : memories(m) {}
    bool asks_for_scene() const noexcept override { return true; }
    std::unique_ptr<RowMemory> memory() const override {
      ++memories;
      return std::make_unique<RowMemory>();
    }
    void apply(const PixelRows&, const RowSight& sight, std::uint8_t*) const override {
      EXPECT_NE(sight.memory, nullptr);
    }
    std::atomic<int>& memories;
  };
  std::atomic<int>& memories_;
};

TEST(PointStages, what_they_remember_of_rows_serves_a_thread_for_the_whole_picture) {
  const std::string in = temporary("memory.exr"), out = temporary("memory-out.exr");
  write_exr(in, {picture(300, 200)});
  for (const int threads : {1, 3})
    for (const char* effects : {"shift", "shift,detail"}) {
      std::atomic<int> memories = 0;
      ImageSettings s = settings(0.001, effects);
      s.point_stages.push_back(std::make_shared<const Counting>(memories));
      set_threads(threads);
      run(in, out, s);
      EXPECT_GE(memories, 1) << effects;
      EXPECT_LE(memories, threads) << effects;
    }
  set_threads(0);
}

TEST(NoiseStage, moves_with_the_frame_and_each_frame_is_its_own_whoever_makes_it) {
  const std::string in = temporary("noise.exr"), a = temporary("noise-a.exr"), b = temporary("noise-b.exr");
  write_exr(in, {picture()});
  ImageSettings s = settings(0.001, "noise");
  s.sequence = true;
  std::vector<std::vector<std::uint32_t>> frames;
  for (const int frame : {0, 1, 24}) {
    EXPECT_TRUE(run(in, a, s, frame).scene.plan.effect("noise").runs());
    frames.push_back(bits(a));
  }
  EXPECT_NE(frames[0], frames[1]);
  EXPECT_NE(frames[1], frames[2]);
  for (const int threads : {1, 3}) {
    set_threads(threads);
    run(in, b, s, 24);
    EXPECT_EQ(bits(b), frames[2]) << threads;
  }
  set_threads(0);
  // Frame 24 at 24 a second is frame 12 at 12.
  s.choice.stages.set("fps", 12.0);
  run(in, b, s, 12);
  EXPECT_EQ(bits(b), frames[2]);
  s.choice.stages.set("seed", 1.0);
  run(in, b, s, 12);
  EXPECT_NE(bits(b), frames[2]);
}

TEST(NoiseStage, lies_in_the_display_window_whatever_the_data_window_is) {
  const std::string in = temporary("noise-whole.exr"), out = temporary("noise-whole-out.exr");
  TestPart whole = picture();
  write_exr(in, {whole});
  run(in, out, settings(0.001, "noise"));
  const std::vector<std::uint32_t> before = bits(in), after = bits(out);
  TestPart crop = whole;
  crop.data = {40, 11, 141, 60};
  write_exr(in, {crop});
  run(in, out, settings(0.001, "noise"));
  const std::vector<std::uint32_t> before_crop = bits(in), after_crop = bits(out);
  int same = 0;
  for (int y = 11; y < 60; ++y)
    for (int x = 40; x < 141; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * 300 + x),
                        j = static_cast<std::size_t>((y - 11) * 101 + x - 40);
      if (before[i] != before_crop[j]) continue;  // the test's pixels go by the data window
      ASSERT_EQ(after[i], after_crop[j]) << x << ' ' << y;
      ++same;
    }
  EXPECT_GT(same, 0);
}

TEST(NoiseStage, is_in_a_still_where_it_is_named_and_in_a_sequence_where_it_is_called_for) {
  const std::string in = temporary("noise-plan.exr"), out = temporary("noise-plan-out.exr");
  write_exr(in, {picture()});
  const struct {
    double adaptation;
    const char* effects;
    bool sequence, runs;
  } rows[] = {{0.001, "auto", false, false}, {0.001, "auto", true, true},      {0.001, "noise", false, true},
              {0.0029, "auto", true, true},  {0.0029757, "auto", true, false}, {1, "auto", true, false}};
  for (const auto& row : rows) {
    ImageSettings s = settings(row.adaptation, row.effects);
    s.sequence = row.sequence;
    EXPECT_EQ(run(in, out, s).scene.plan.effect("noise").runs(), row.runs) << row.adaptation << row.effects;
  }
}

TEST(TimeStage, an_eye_that_was_ever_in_this_light_changes_no_bit) {
  const std::string in = temporary("time.exr"), a = temporary("time-a.exr"), b = temporary("time-b.exr");
  write_exr(in, {picture()});
  run(in, a, settings(0.01, "auto"));
  ImageSettings s = settings(0.01, "auto");
  s.time.history = {{0.01, 36000}};
  const ImageReport report = run(in, b, s);
  EXPECT_FALSE(report.scene.plan.effect("time").runs()) << report.scene.plan.effect("time").reason;
  EXPECT_EQ(bits(a), bits(b));
}

TEST(TimeStage, what_is_seen_out_of_bright_light_is_the_exposure_s_share) {
  const std::string in = temporary("time.exr"), out = temporary("time-out.exr");
  write_exr(in, {picture()});
  ImageSettings s = settings(0.01, "none");
  s.time.history = {{1000, 600}};
  const ImageReport report = run(in, out, s);
  const AdaptationThresholds expected = thresholds_of(state_after(s.time.history), 0.01);
  ASSERT_TRUE(report.scene.adapting);
  EXPECT_EQ(report.scene.adapting->thresholds.exposure, expected.exposure);
  const std::vector<std::uint32_t> before = bits(in), after = bits(out);
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_EQ(std::bit_cast<float>(after[i]),
              std::bit_cast<float>(before[i]) * static_cast<float>(expected.exposure));
}

TEST(TimeStage, bleached_rods_shift_no_colour) {
  const std::string in = temporary("time.exr"), adapted = temporary("time-adapted.exr"),
                    out = temporary("time-bleached.exr");
  write_exr(in, {picture()});
  run(in, adapted, settings(0.01, "shift"));
  ImageSettings s = settings(0.01, "shift");
  s.time.history = {{1e4, 600}};
  const ImageReport report = run(in, out, s);
  const auto exposure = static_cast<float>(report.scene.adapting->thresholds.exposure);
  EXPECT_GT(report.scene.adapting->thresholds.rod_luminance, 5);
  double shifted = 0;
  const std::vector<std::uint32_t> before = bits(in), after = bits(out), usual = bits(adapted);
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(std::bit_cast<float>(after[i]), std::bit_cast<float>(before[i]) * exposure) << i;
    shifted += before[i] != usual[i];
  }
  EXPECT_GT(shifted, 0.5 * static_cast<double>(before.size()));
}

TEST(DetailStage, is_by_contrast_unless_another_filter_is_named) {
  const std::string in = temporary("detail.exr"), out = temporary("detail-out.exr");
  write_exr(in, {picture()});
  const auto seen = [&](const char* filter) {
    ImageSettings s = settings(0.01, "detail");
    if (*filter) s.choice.stages.set("detail", filter);
    const ImageReport report = run(in, out, s);
    std::string stamped;
    for (const Attribute& stamp : report.stamps)
      if (stamp.name == "scotopic:detail") stamped = std::get<std::string>(stamp.value);
    EXPECT_EQ(stamped, filter == std::string_view("none") ? "" : *filter ? filter : "contrast");
    return bits(out);
  };
  const std::vector<std::uint32_t> usual = seen("");
  EXPECT_EQ(usual, seen("contrast"));
  EXPECT_NE(usual, seen("bilateral"));
  EXPECT_NE(seen("bilateral"), seen("bilateral-local"));
  EXPECT_EQ(seen("none"), bits(in));
}

TEST(DetailStage, strength_0_and_light_enough_leave_every_bit) {
  const std::string in = temporary("detail.exr"), out = temporary("detail-out.exr");
  write_exr(in, {picture()});
  ImageSettings s = settings(0.01, "detail");
  s.choice.stages.set("strength-detail", 0.0);
  run(in, out, s);
  EXPECT_EQ(bits(in), bits(out));
  ImageSettings day = settings(30, "auto");
  EXPECT_FALSE(run(in, out, day).scene.plan.effect("detail").needed);
}

}  // namespace
}  // namespace scotopic

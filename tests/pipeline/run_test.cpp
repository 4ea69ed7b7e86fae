// The one call: how often a file is decoded, what stages are told, and that whole pictures go through stages
// of their own.
#include "pipeline/run.h"
#include "pipeline/stages/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "pipeline/rows/threads.h"
#include "support/exr_files.h"

namespace scotopic {
namespace {

using test::read_bits;
using test::temporary;
using test::TestPart;
using test::write_exr;

const std::vector<Channel> rgb_float = {{"B", PixelType::float32},
                                        {"G", PixelType::float32},
                                        {"R", PixelType::float32},
                                        {"Z", PixelType::float32}};

/// A picture whose data window begins elsewhere than its display window.
TestPart offset_picture(int width = 700, int height = 83) {
  TestPart part;
  part.channels = rgb_float;
  part.finite = true;
  part.data = {-5, -7, -5 + width, -7 + height};
  part.display = {0, 0, 640, 70};
  return part;
}

ImageSettings plain_settings(double adaptation) {
  ImageSettings out(ColourConfig::own());
  if (adaptation > 0) out.choice.adaptation = adaptation;
  out.choice.white_luminance = 1;
  set_primaries(out.choice, out.config);
  return out;
}

ImageReport run_file(const std::string& in, const std::string& out, const ImageSettings& s, ImageJob job = {},
                     const Notes& notes = {}) {
  job.input = in;
  job.output = out;
  ExactEvaluators evaluators;
  return run_image(job, s, evaluators, notes);
}

float value(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// Values of a channel, row by row.
std::vector<float> float_values(const std::string& file, const std::string& channel) {
  std::vector<float> out;
  for (const std::uint32_t bits : read_bits(file, 0, 0, 0, channel)) out.push_back(value(bits));
  return out;
}

/// Writes what it is told into the pixels: where each lies, when, and what the pixel stages saw there.
class Witness : public RowStage {
 public:
  explicit Witness(bool asks) : asks_(asks) {}
  bool asks_for_scene() const noexcept override { return asks_; }
  void apply(const PixelRows& rows, const RowSight& sight, std::uint8_t* touched) const override {
    EXPECT_EQ(asks_, sight.scene.r != nullptr);
    const RowContext& at = sight.at;
    for (std::size_t i = 0; i < rows.count; ++i) {
      rows.r[i] = asks_ ? sight.scene.r[i] : static_cast<float>(at.x + static_cast<int>(i));
      rows.g[i] = asks_ ? sight.scene.g[i] : static_cast<float>(at.y);
      rows.b[i] =
          static_cast<float>(1000 * at.moment.frame + at.display_x1) + static_cast<float>(at.moment.seed);
      touched[i] = 1;
    }
  }

 private:
  bool asks_;
};

EffectDecision always(std::string_view name) {
  EffectDecision out;
  out.effect = name;
  out.asked = out.needed = true;
  return out;
}

class WitnessStage : public PointStage {
 public:
  explicit WitnessStage(bool asks) : asks_(asks) {}
  std::string_view name() const noexcept override { return "witness"; }
  EffectDecision decide(const StageScene&) const override { return always(name()); }
  std::unique_ptr<const RowStage> make(const StageScene&, const Notes&) const override {
    return std::make_unique<const Witness>(asks_);
  }
  std::vector<Attribute> stamps(const StageScene&) const override { return {}; }

 private:
  bool asks_;
};

std::shared_ptr<const PointStage> witness(bool asks) { return std::make_shared<const WitnessStage>(asks); }

/// The bilateral filter, where it is wanted.
void set_acuity(ImageSettings& s, bool on) {
  s.viewing.pixels_per_degree = 60;
  s.choice.stages.set("detail", on ? "bilateral" : "none");
  s.filter_stages.clear();
  add_detail(s.choice.stages, s);
}

TEST(Run, a_row_stage_is_told_where_and_when_its_pixels_are) {
  const std::string in = temporary("where.exr"), out = temporary("where-out.exr");
  const TestPart part = offset_picture();
  write_exr(in, {part});
  for (const bool acuity : {false, true}) {
    ImageSettings s = plain_settings(0.01);
    s.point_stages = {witness(false)};
    set_acuity(s, acuity);
    ImageJob job;
    job.moment = {7, 0.25, 3};
    run_file(in, out, s, job);
    const std::vector<float> r = float_values(out, "R"), g = float_values(out, "G"),
                             b = float_values(out, "B");
    ASSERT_EQ(r.size(), 700u * 83u);
    for (std::size_t i = 0; i < r.size(); ++i) {
      ASSERT_EQ(r[i], static_cast<float>(static_cast<int>(i % 700) - 5)) << i;
      ASSERT_EQ(g[i], static_cast<float>(static_cast<int>(i / 700) - 7)) << i;
      ASSERT_EQ(b[i], 7643.0f) << i;
    }
  }
}

TEST(Run, a_row_stage_gets_the_light_that_the_pixel_stages_saw_if_it_asks) {
  const std::string in = temporary("planes.exr"), out = temporary("planes-out.exr");
  write_exr(in, {offset_picture()});
  for (const bool acuity : {false, true}) {
    ImageSettings s = plain_settings(0.02);
    s.choice.white_luminance = 3;
    s.point_stages = {witness(true)};
    set_acuity(s, acuity);
    const ImageReport report = run_file(in, out, s);
    for (const char* channel : {"R", "G"})
      EXPECT_EQ(read_bits(in, 0, 0, 0, channel), read_bits(out, 0, 0, 0, channel)) << channel << acuity;
    EXPECT_EQ(report.evaluator->name(), "float");
  }
}

/// What the stages of these tests have in common.
class TestStage : public FrameStage {
 public:
  explicit TestStage(std::string_view name) : name_(name) {}
  std::string_view name() const noexcept override { return name_; }
  EffectDecision decide(const StageScene&) const override {
    EffectDecision out = always(name_);
    out.needed = false;
    return out;
  }
  std::int64_t bytes(const FrameSize&, const StageScene&) const override { return 0; }
  std::vector<Attribute> stamps(const StageScene&) const override {
    return {{"test:" + std::string(name_), 1.0}};
  }

 private:
  std::string_view name_;
};

/// Mirrors the picture left to right: no stage that sees less than all of it can.
class Mirror : public TestStage {
 public:
  explicit Mirror(std::int64_t room = 0) : TestStage("mirror"), room_(room) {}
  std::int64_t bytes(const FrameSize&, const StageScene&) const override { return room_; }
  FrameOutcome run(const FramePlanes& light, const StageScene&,
                   const ParallelFor& parallel_for) const override {
    parallel_for(light.height, [&](int y) {
      for (float* const plane : light.rgb)
        std::reverse(plane + y * light.stride, plane + y * light.stride + light.width);
    });
    return {true, "always", 1};
  }

 private:
  std::int64_t room_;
};

TEST(Run, a_frame_stage_sees_the_whole_picture_before_the_operator) {
  const std::string in = temporary("frame.exr"), mirrored = temporary("frame-mirrored.exr");
  const std::string out = temporary("frame-out.exr"), plain = temporary("frame-plain.exr");
  write_exr(in, {offset_picture()});
  ImageSettings daylight = plain_settings(10);
  daylight.frame_stages = {std::make_shared<const Mirror>()};
  const ImageReport report = run_file(in, mirrored, daylight);
  EXPECT_TRUE(report.scene.plan.effect("mirror").runs());
  EXPECT_EQ(report.stamps.back().name, "test:mirror");
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float> before = float_values(in, channel), after = float_values(mirrored, channel);
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_EQ(after[i], before[i - i % 700 + 699 - i % 700]) << channel << i;
  }
  EXPECT_EQ(read_bits(in, 0, 0, 0, "Z"), read_bits(mirrored, 0, 0, 0, "Z"));
  // What follows works on what it left: as on a file that holds it.
  for (const bool acuity : {false, true}) {
    ImageSettings night = plain_settings(0.02), then = plain_settings(0.02);
    for (ImageSettings* s : {&night, &then}) set_acuity(*s, acuity);
    night.frame_stages = daylight.frame_stages;
    run_file(in, out, night);
    run_file(mirrored, plain, then);
    for (const char* channel : {"R", "G", "B"})
      EXPECT_EQ(read_bits(out, 0, 0, 0, channel), read_bits(plain, 0, 0, 0, channel)) << channel << acuity;
  }
}

/// Makes all light a tenth.
class Dim : public TestStage {
 public:
  Dim() : TestStage("dim") {}
  FrameOutcome run(const FramePlanes& light, const StageScene& scene, const ParallelFor&) const override {
    adaptation = scene.parameters.adaptation;
    for (int y = 0; y < light.height; ++y)
      for (float* const plane : light.rgb)
        for (int x = 0; x < light.width; ++x) plane[y * light.stride + x] *= 0.125f;
    return {true, "always", 1};
  }
  mutable double adaptation = 0;
};

TEST(Run, a_frame_stage_knows_the_adaptation_to_its_input_and_the_others_that_to_its_result) {
  const std::string in = temporary("dim.exr"), out = temporary("dim-out.exr");
  write_exr(in, {offset_picture()});
  const auto dim = std::make_shared<const Dim>();
  ImageSettings s = plain_settings(0);
  const double before = run_file(in, out, s).scene.numbers.adaptation;
  s.frame_stages = {dim};
  const double after = run_file(in, out, s).scene.numbers.adaptation;
  EXPECT_EQ(dim->adaptation, before);
  EXPECT_NEAR(after, before / 8, 1e-6 * before);
}

TEST(Run, memory_of_whole_pictures_is_planned_before_it_is_taken_and_told) {
  const std::string in = temporary("memory.exr"), out = temporary("memory-out.exr");
  write_exr(in, {offset_picture()});
  ImageSettings s = plain_settings(0.02);
  s.frame_stages = {std::make_shared<const Mirror>(std::int64_t{1} << 40)};
  try {
    run_file(in, out, s);
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::limit);
  }
  s.frame_stages = {std::make_shared<const Mirror>()};
  std::vector<std::string> lines;
  const Notes notes = {nullptr, [&](const std::string& line) { lines.push_back(line); }};
  run_file(in, out, s, {}, notes);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("whole picture is kept") != std::string::npos;
  }));
}

TEST(Run, an_adaptation_track_has_a_value_for_each_frame) {
  const std::string in = temporary("track.exr"), out = temporary("track-out.exr"),
                    plain = temporary("track-plain.exr");
  write_exr(in, {offset_picture()});
  ImageJob job;
  job.adaptation = TrackedAdaptation{0.03, "the track's", {}};
  const ImageReport report = run_file(in, out, plain_settings(4), job);
  EXPECT_EQ(report.scene.numbers.adaptation, 0.03);
  EXPECT_EQ(report.scene.numbers.adaptation_source, "the track's");
  run_file(in, plain, plain_settings(0.03));
  EXPECT_EQ(read_bits(out, 0, 0, 0, "R"), read_bits(plain, 0, 0, 0, "R"));
}

TEST(Run, bytes_depend_neither_on_threads_nor_on_stages_that_do_nothing) {
  const std::string in = temporary("threads.exr"), out = temporary("threads-out.exr");
  write_exr(in, {offset_picture(1300, 211)});
  std::vector<std::uint32_t> first;
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    ImageSettings s = plain_settings(0);
    s.frame_stages = {std::make_shared<const Mirror>(), std::make_shared<const Mirror>()};
    run_file(in, out, s);
    const std::vector<std::uint32_t> twice = read_bits(out, 0, 0, 0, "R");
    run_file(in, out, plain_settings(0));
    if (first.empty()) first = twice;
    EXPECT_TRUE(twice == first) << threads;
    EXPECT_TRUE(read_bits(out, 0, 0, 0, "R") == first) << threads;
  }
  set_threads(0);
}

TEST(Run, a_scene_is_read_without_a_place_to_write) {
  const std::string in = temporary("read.exr"), out = temporary("read-out.exr");
  write_exr(in, {offset_picture()});
  ImageJob job;
  job.input = in;
  const SceneReport seen = read_scene(job, plain_settings(0), Statistics::of_all_pixels, {});
  const ImageReport made = run_file(in, out, plain_settings(0));
  EXPECT_EQ(seen.numbers.adaptation, made.scene.numbers.adaptation);
  EXPECT_EQ(seen.statistics->photopic.count(), 700u * 83u);
}

}  // namespace
}  // namespace scotopic

// The installed door. Bytes against the program: tests/python, tests/ofx, by the same operator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "scotopic/operator.h"

namespace scotopic {
namespace {

constexpr int width = 40, height = 30;

std::vector<float> night(int channels) {
  std::vector<float> out(static_cast<std::size_t>(width * height * channels), 0.02f);
  for (std::size_t i = 0; i < 12; ++i) out[static_cast<std::size_t>(width * 15 * channels) + i] = 40;
  return out;
}

MemoryPixels pixels(std::vector<float>& values, int channels) {
  MemoryPixels out;
  out.data = reinterpret_cast<std::byte*>(values.data());
  out.width = width;
  out.height = height;
  out.channels = channels;
  out.channel_stride = sizeof(float);
  out.pixel_stride = channels * out.channel_stride;
  out.row_stride = width * out.pixel_stride;
  return out;
}

const PlannedStage& stage(const Plan& plan, const std::string& name) {
  for (const PlannedStage& s : plan.stages)
    if (s.name == name) return s;
  throw std::out_of_range(name);
}

TEST(Door, an_image_is_seen_and_the_plan_says_how) {
  std::vector<float> in = night(3), out(in.size());
  Frame frame;
  frame.in = pixels(in, 3);
  frame.out = pixels(out, 3);
  std::vector<std::string> notes;
  const Operator street(
      {{"adaptation", "street"}, {"effects", "all"}, {"ppd", "10"}, {"white_luminance", "5"}});
  const Plan plan = street.apply(frame, [&](const std::string& line) { notes.push_back(line); });
  EXPECT_EQ(plan.adaptation, 0.1);
  EXPECT_EQ(plan.white_luminance, 5);
  EXPECT_TRUE(stage(plan, "glare").runs);
  EXPECT_TRUE(stage(plan, "shift").runs && !stage(plan, "shift").reason.empty());
  EXPECT_FALSE(notes.empty());
  EXPECT_NE(std::memcmp(in.data(), out.data(), in.size() * sizeof(float)), 0);
  EXPECT_EQ(in, night(3));
  const Plan before = street.plan(frame);
  for (const PlannedStage& s : plan.stages) EXPECT_EQ(stage(before, s.name).runs, s.runs) << s.name;
}

TEST(Door, daylight_calls_for_nothing_and_leaves_every_bit) {
  std::vector<float> rgba = night(4);
  rgba[5] = std::nanf("7");
  const std::vector<float> before = rgba;
  Frame frame;
  frame.in = frame.out = pixels(rgba, 4);
  EXPECT_TRUE(Operator(Parameters{{"adaptation", "100"}}).apply(frame).nothing());
  EXPECT_EQ(std::memcmp(rgba.data(), before.data(), rgba.size() * sizeof(float)), 0);
}

TEST(Door, a_lut_and_a_shader_and_a_report_come_out_of_the_same_operator) {
  std::vector<float> in = night(3);
  Frame frame;
  frame.in = frame.out = pixels(in, 3);
  const Operator moon(Parameters{{"adaptation", "moon"}});
  const std::string file = testing::TempDir() + "/door_moon.clf";
  moon.bake(file, 17);
  EXPECT_GT(std::filesystem::file_size(file), 10000u);
  EXPECT_NE(moon.shader("dctl").find("__DEVICE__"), std::string::npos);
  EXPECT_NE(moon.explain(frame).find("\"spRatio\""), std::string::npos);
}

TEST(Door, mistakes_are_errors_with_the_programs_words) {
  const auto code = [](const Parameters& p) {
    try {
      const Operator made(p);
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::done;
  };
  EXPECT_EQ(code({{"adaptation", "-1"}}), ExitCode::usage);
  EXPECT_EQ(code({{"no_such", "1"}}), ExitCode::usage);
  EXPECT_EQ(code({{"adaptation", "1"}, {"colorspace", "no such"}}), ExitCode::config);
  EXPECT_EQ(code({{"adaptation", "1"}}), ExitCode::done);
  std::vector<float> in = night(3);
  Frame frame;
  frame.in = frame.out = pixels(in, 3);
  frame.out.data += frame.out.row_stride;
  frame.in.height = frame.out.height = height - 1;
  EXPECT_THROW(Operator(Parameters{{"adaptation", "1"}}).apply(frame), Error);
}

}  // namespace
}  // namespace scotopic

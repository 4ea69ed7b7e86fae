// Stages that look around, or at where and when a pixel is, on whole images.
#include "pipeline/stages/stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "adaptation/chromatic_adaptation.h"
#include "color/colour_config.h"
#include "pipeline/rows/threads.h"
#include "pipeline/run.h"
#include "support/exr_files.h"

namespace scotopic {
namespace {

using test::read_bits;
using test::temporary;
using test::TestPart;
using test::write_exr;

TestPart picture(int width = 300, int height = 83) {
  TestPart part;
  part.finite = true;
  part.data = part.display = {0, 0, width, height};
  for (const char* name : {"R", "G", "B"}) part.channels.push_back({name, PixelType::float32});
  return part;
}

ImageSettings settings(double adaptation, const std::string& effects) {
  ImageSettings s(ColourConfig::own());
  s.choice.adaptation = adaptation;
  s.choice.white_luminance = adaptation / 0.18;
  s.choice.plan_effects = effects == "auto";
  s.choice.stages.set_effects(effects);
  s.choice.stages.set_pixel_stages(s.choice.parameters);
  s.viewing.pixels_per_degree = 30;
  set_primaries(s.choice, s.config);
  return s;
}

ImageReport run(const std::string& in, const std::string& out, ImageSettings s, int frame = 0) {
  add_stages(s);
  ImageJob job;
  job.input = in;
  job.output = out;
  job.moment.frame = frame;
  ExactEvaluators evaluators;
  return run_image(job, s, evaluators, {});
}

std::vector<std::uint32_t> bits(const std::string& file) { return read_bits(file, 0, 0, 0, "G"); }

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

TEST(LampStage, takes_a_lamp_s_white_as_far_to_d65_as_the_degree_says) {
  const std::string in = temporary("lamp.exr"), out = temporary("lamp-out.exr");
  write_exr(in, {picture()});
  ImageSettings s = settings(0.01, "none");
  s.choice.lamp = Vec3<double>{1.2, 1, 0.3};
  const ImageReport report = run(in, out, s);
  EXPECT_TRUE(report.scene.plan.effect("lamp").runs());
  // CIECAM02: D at 0.01 cd/m2 in an average surround.
  EXPECT_NEAR(report.scene.plan.effect("lamp").number, 0.824052, 1e-6);
  const Matrix3<double>& xyz = s.choice.parameters.xyz_from_rgb;
  const Matrix3<double> m =
      inverse(xyz) * (adapt_to_lamp({1.2, 1, 0.3}, report.scene.plan.effect("lamp").number) * xyz);
  std::vector<std::uint32_t> planes[3], results[3];
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = read_bits(in, 0, 0, 0, std::string(1, "RGB"[c]));
    results[c] = read_bits(out, 0, 0, 0, std::string(1, "RGB"[c]));
  }
  for (std::size_t i = 0; i < planes[0].size(); ++i) {
    const Vec3<double> rgb = {std::bit_cast<float>(planes[0][i]), std::bit_cast<float>(planes[1][i]),
                              std::bit_cast<float>(planes[2][i])};
    const Vec3<double> expected = m * rgb;
    if (std::min({expected[0], expected[1], expected[2]}) < 0) continue;  // see below
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(std::bit_cast<float>(results[c][i]), expected[c], 1e-6 * (rgb[0] + rgb[1] + rgb[2])) << i;
  }
}

TEST(LampStage, what_leaves_the_gamut_fades_at_its_luminance) {
  const std::string in = temporary("lamp.exr"), out = temporary("lamp-out.exr");
  write_exr(in, {picture()});
  ImageSettings s = settings(0.01, "none");
  s.choice.lamp = Vec3<double>{1.3, 1, 0.05};
  run(in, out, s);
  int faded = 0;
  const Vec3<double> y = s.choice.parameters.xyz_from_rgb[1];
  const Matrix3<double>& xyz = s.choice.parameters.xyz_from_rgb;
  const Matrix3<double> m = inverse(xyz) * (adapt_to_lamp({1.3, 1, 0.05}, adaptation_degree(0.01)) * xyz);
  std::vector<std::uint32_t> planes[3], results[3];
  for (std::size_t c = 0; c < 3; ++c) {
    planes[c] = read_bits(in, 0, 0, 0, std::string(1, "RGB"[c]));
    results[c] = read_bits(out, 0, 0, 0, std::string(1, "RGB"[c]));
  }
  for (std::size_t i = 0; i < planes[0].size(); ++i) {
    Vec3<double> rgb, seen;
    for (std::size_t c = 0; c < 3; ++c) {
      rgb[c] = std::bit_cast<float>(planes[c][i]);
      seen[c] = std::bit_cast<float>(results[c][i]);
    }
    const Vec3<double> expected = m * rgb;
    if (std::min({expected[0], expected[1], expected[2]}) >= 0) continue;
    ++faded;
    const double light = rgb[0] + rgb[1] + rgb[2];
    ASSERT_NEAR(dot(y, seen), dot(y, expected), 1e-6 * light) << i;
    ASSERT_NEAR(std::min({seen[0], seen[1], seen[2]}), 0, 1e-6 * light) << i;
  }
  EXPECT_GT(faded, 100);
}

TEST(LampStage, no_lamp_or_d65_changes_no_bit) {
  const std::string in = temporary("lamp.exr"), out = temporary("lamp-out.exr");
  write_exr(in, {picture()});
  for (const std::optional<Vec3<double>>& lamp :
       {std::optional<Vec3<double>>(), std::optional(adapted_white)}) {
    ImageSettings s = settings(0.01, "none");
    s.choice.lamp = lamp;
    EXPECT_FALSE(run(in, out, s).scene.plan.effect("lamp").runs());
    EXPECT_EQ(bits(in), bits(out));
  }
}

}  // namespace
}  // namespace scotopic

// Stage lamp on whole images, of RGB and of receptors' signals.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <optional>

#include "adaptation/chromatic_adaptation.h"
#include "pipeline/stage_runs.h"
#include "receptors/receptor_space.h"
#include "stages/reference.h"

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

/// A channel's values.
std::vector<double> values_in_double(const std::string& file, const char* channel) {
  std::vector<double> out;
  for (const std::uint32_t word : read_bits(file, 0, 0, 0, channel))
    out.push_back(static_cast<double>(std::bit_cast<float>(word)));
  return out;
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

// Colour as the eye sees it, cones too; rods, whose signal no colour changes, keep theirs.
TEST(LampStage, adapts_cones_signals_of_a_file_and_leaves_its_rods) {
  const std::string in = temporary("lamp-lmsr.exr"), out = temporary("lamp-out.exr");
  TestPart part = picture(120, 50);
  part.channels.clear();
  for (const char* name : {"L", "M", "R", "S"}) part.channels.push_back({name, PixelType::float32});
  write_exr(in, {part});
  ImageSettings s = settings(0.01, "shift,luminance,chroma");
  s.choice.lamp = Vec3<double>{1.2, 1, 0.3};
  EXPECT_TRUE(run(in, out, s).scene.plan.effect("lamp").runs());

  const AppearanceParameters p = parameters_of(s.choice, 0.01, 0.01 / 0.18);
  const AppearanceReference reference(p);
  const Matrix3<double> m = adapt_to_lamp({1.2, 1, 0.3}, adaptation_degree(0.01));
  const Vec3<double>& y = p.xyz_from_rgb[1];
  const auto l = values_in_double(in, "L"), mid = values_in_double(in, "M"), sh = values_in_double(in, "S"),
             rod = values_in_double(in, "R");
  const auto r = values_in_double(out, "R"), g = values_in_double(out, "G"), b = values_in_double(out, "B");
  double worst = 0, of_rods = 0;
  for (std::size_t i = 0; i < l.size(); ++i) {
    const Vec3<double> xyz = xyz_from_lms() * Vec3<double>{l[i], mid[i], sh[i]};
    const Vec3<double> as_it_came = inverse(p.xyz_from_rgb) * xyz;
    Vec3<double> seen = inverse(p.xyz_from_rgb) * (m * xyz);
    const double floor = std::min({0.0, as_it_came[0], as_it_came[1], as_it_came[2]});
    const double least = std::min({seen[0], seen[1], seen[2]}), grey = dot(y, seen);
    if (least < floor && grey > floor)
      for (double& c : seen) c = grey + (grey - floor) / (grey - least) * (c - grey);
    const Vec3<double> cones = lms_from_xyz() * (m * xyz);
    const Vec3<double> expected = reference({seen, cones, rod[i]});
    const Vec3<double> other = reference({seen, cones, 0.5 * rod[i]});
    const Vec3<double> got = {r[i], g[i], b[i]};
    double size = rod[i];
    for (const Vec3<double>& v : {as_it_came, seen, cones, expected})
      for (const double x : v) size = std::max(size, std::abs(x));
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, std::abs(got[c] - expected[c]) / size);
      of_rods = std::max(of_rods, std::abs(other[c] - expected[c]) / size);
    }
  }
  std::printf("lamp on LMSR: worst %.2g of the largest number; rods halved would be %.2g\n", worst, of_rods);
  EXPECT_LE(worst, 1e-5);
  EXPECT_GE(of_rods, 0.01);
}

}  // namespace
}  // namespace scotopic

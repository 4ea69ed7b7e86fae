// What the contrast filter does to gratings, walls, lamps, stars, black and holes.
#include "stages/contrast/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>

#include "stages/contrast/judge.h"

namespace scotopic {
namespace {

using test::Picture;

/// Mean and standard deviation of log10 luminance inside a margin.
struct LogStatistics {
  double mean = 0, deviation = 0;
};
LogStatistics log_statistics(const Picture& p, int margin) {
  double sum = 0, squares = 0, n = 0;
  for (int y = margin; y < p.height - margin; ++y)
    for (int x = margin; x < p.width - margin; ++x) {
      const double l = std::log10(static_cast<double>(p.planes[1][p.at(x, y)]));
      sum += l;
      squares += l * l;
      ++n;
    }
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / n / n))};
}

/// Rows alike; log10 luminance is a sine of standard deviation `contrast` and `period` pixels about a mean
/// light of `mean`.
Picture grating(double contrast, double period, double mean, int size = 96) {
  Picture p(size, size);
  const auto light = [&](int x) {
    return std::pow(10.0, std::sqrt(2.0) * contrast * std::sin(2 * std::numbers::pi * (x + 0.37) / period));
  };
  double sum = 0;
  for (int x = 0; x < 48; ++x) sum += light(x) / 48;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) p.grey(x, y, light(x) * mean / sum);
  return p;
}

/// Half of what the eye is adapted to is the light around: together `luminance`. The display is at its peak.
ContrastParameters eye_at(double luminance, double pixels_per_degree) {
  ContrastParameters p;
  p.adaptation = luminance / 2;
  p.pixels_per_degree = pixels_per_degree;
  p.display = {1e9, 100.0};
  return p;
}

double kept(double contrast, double pixels_per_degree, double frequency, double luminance) {
  const Picture in = grating(contrast, pixels_per_degree / frequency, luminance / 2);
  const Picture out = test::filtered(eye_at(luminance, pixels_per_degree), in);
  return log_statistics(out, 24).deviation / log_statistics(in, 24).deviation;
}

// Wanat and Mantiuk's rule at 4 cycles per degree, the middle of the finest band at 16 pixels per degree. The
// rule speaks of one frequency; in the picture 6 % of the grating lie in the next band, so that less is left.
TEST(ContrastFilter, a_grating_keeps_what_stands_above_its_threshold) {
  const struct {
    double luminance, contrast, kept, tolerance;
  } cases[] = {
      {0.01, 0.5, 0.7104, 0.04}, {0.01, 0.2, 0.2760, 0.04}, {0.01, 0.146, 0.0068, 0.01},
      {0.01, 0.05, 0.02, 0.01},  {0.1, 0.2, 0.8589, 0.04},  {0.1, 0.05, 0.4356, 0.04},
      {10, 0.05, 0.99, 0.01},    {100, 0.05, 1, 0.001},
  };
  for (const auto& c : cases) {
    const double measured = kept(c.contrast, 16, 4, c.luminance);
    std::printf("  %5.3f cd/m2, contrast %.3f: %.4f kept, %.4f expected\n", c.luminance, c.contrast, measured,
                c.kept);
    EXPECT_NEAR(measured, c.kept, c.tolerance) << c.luminance << " cd/m2, contrast " << c.contrast;
  }
}

TEST(ContrastFilter, nothing_is_called_for_from_1_cd_per_m2_up_to_4_cycles_per_degree) {
  EXPECT_GT(kept(0.1, 16, 4, 1.0), 0.94);
  EXPECT_FALSE(contrast::contrast_need(1.0, 16, 100).needed);
}

/// A wall, weak texture on its left half, strong on its right.
Picture wall() {
  Picture p(160, 96);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const double texture = std::sin(1.5 * x + 0.3 * y) * std::cos(0.4 * x - 1.4 * y);
      p.grey(x, y, std::pow(10.0, (x < 80 ? 0.1 : 0.8) * texture));
    }
  return p;
}

double deviation_in(const Picture& p, int x0, int x1) {
  Picture part(x1 - x0, p.height - 32);
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) part.planes[1][part.at(x, y)] = p.planes[1][p.at(x + x0, y + 16)];
  return log_statistics(part, 0).deviation;
}

TEST(ContrastFilter, a_textured_wall_loses_weak_contrast_first) {
  const Picture in = wall();
  double weak_before = 1;
  for (double adaptation : {1.0, 0.1, 0.03, 0.01}) {
    ContrastParameters p;
    p.adaptation = p.unit = adaptation;
    p.pixels_per_degree = 16;
    p.display = {1e9, 100};
    const Picture out = test::filtered(p, in);
    const double weak = deviation_in(out, 16, 64) / deviation_in(in, 16, 64);
    const double strong = deviation_in(out, 96, 144) / deviation_in(in, 96, 144);
    std::printf("  %.2f cd/m2: weak texture keeps %.3f, strong %.3f\n", adaptation, weak, strong);
    EXPECT_LT(weak, strong);
    EXPECT_LT(weak, weak_before);
    weak_before = weak;
  }
  EXPECT_LT(weak_before, 0.1);
}

/// A disc of 8 pixels' radius on a ground of 1.
Picture lamp(double light) {
  Picture p(65, 65);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) p.grey(x, y, std::hypot(x - 32, y - 32) < 8 ? light : 1.0);
  return p;
}

/// Greatest factor on the ground around the lamp.
double rise_around(const std::vector<double>& change) {
  double most = 0;
  for (int y = 0; y < 65; ++y)
    for (int x = 0; x < 65; ++x)
      if (std::hypot(x - 32, y - 32) >= 8)
        most = std::max(most, change[static_cast<std::size_t>(65 * y + x)]);
  return std::pow(10.0, most);
}

// The ground at a lamp's rim, in units of the ground: a lamp's light on one pixel beside it would be 1e4. The
// mean of log luminance, as in the paper's code, takes the surround for dark and smears the rim.
TEST(ContrastFilter, a_lamp_has_no_halo) {
  const struct { double ppd, most; } cases[] = {{20, 1.1}, {40, 1.4}, {64, 1.6}};
  for (const auto& c : cases) {
    ContrastParameters p;
    p.adaptation = p.unit = 0.01;
    p.pixels_per_degree = c.ppd;
    p.display = {278, 100};
    const Picture in = lamp(1e4), out = test::filtered(p, in);
    double most = 0, lamp_least = 1e9;
    for (int y = 0; y < 65; ++y)
      for (int x = 0; x < 65; ++x) {
        const double v = static_cast<double>(out.planes[1][out.at(x, y)]);
        if (std::hypot(x - 32, y - 32) >= 8)
          most = std::max(most, v);
        else
          lamp_least = std::min(lamp_least, v);
      }
    test::JudgeChoices log_surround;
    log_surround.surround = test::JudgeChoices::Surround::log;
    std::printf("  ppd %2.0f: ground rises to %.3f at most (surround in log: %.3f), lamp falls to %.4f\n",
                c.ppd, most, rise_around(test::judged_change(p, in, log_surround)), lamp_least / 1e4);
    EXPECT_LT(most, c.most) << c.ppd;
    EXPECT_GT(lamp_least, 0.97e4) << c.ppd;
  }
}

TEST(ContrastFilter, a_star_of_one_pixel_stays_and_a_black_pixel_fills) {
  ContrastParameters p;
  p.adaptation = p.unit = 0.002;
  p.pixels_per_degree = 32;
  p.display = {500, 100};
  Picture in(65, 65);
  for (int y = 0; y < 65; ++y)
    for (int x = 0; x < 65; ++x) in.grey(x, y, 1);
  in.grey(20, 20, 1000);
  in.grey(45, 45, 0);
  in.planes[2][in.at(45, 20)] = -0.5f;
  const Picture out = test::filtered(p, in);
  const float star = out.planes[1][out.at(20, 20)], black = out.planes[1][out.at(45, 45)];
  std::printf("  a star of 1000 becomes %.0f, black in 1 becomes %.2f\n", static_cast<double>(star),
              static_cast<double>(black));
  EXPECT_GT(star, 10.0f);
  EXPECT_GT(black, 0.2f);
  EXPECT_LE(std::abs(out.planes[2][out.at(45, 20)]), 0.51f) << "a negative component grew";
}

TEST(ContrastFilter, a_flat_picture_keeps_its_bits) {
  for (float value : {1e-6f, 0.18f, 0.3333f, 7.77e4f, 0.0f, -0.2f}) {
    Picture in(77, 51);
    for (int y = 0; y < in.height; ++y)
      for (int x = 0; x < in.width; ++x) in.grey(x, y, static_cast<double>(value));
    const Picture out = test::filtered(eye_at(0.003, 40), in);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(std::memcmp(in.planes[k].data(), out.planes[k].data(), 4 * in.planes[k].size()), 0) << value;
  }
}

TEST(ContrastFilter, a_hole_passes_and_is_seen_by_no_other_pixel) {
  const float holes[] = {std::nanf(""), std::numeric_limits<float>::infinity(), 0x1p121f};
  const ContrastParameters p = eye_at(0.01, 40);
  Picture in = wall();
  for (int i = 0; i < 12; ++i) in.planes[i % 3][in.at(7 + 13 * i, 5 + 7 * i)] = holes[i % 3];
  Picture other = in;
  for (int i = 0; i < 12; ++i) {
    // Whatever else stands there.
    for (auto& plane : other.planes) plane[in.at(7 + 13 * i, 5 + 7 * i)] = holes[(i + 1) % 3];
  }
  const Picture a = test::filtered(p, in), b = test::filtered(p, other);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      const std::size_t i = in.at(x, y);
      for (int k = 0; k < 3; ++k) {
        if (!test::judge::operable(in, i)) {
          EXPECT_EQ(std::memcmp(&a.planes[k][i], &in.planes[k][i], 4), 0) << x << ", " << y;
        } else {
          EXPECT_EQ(std::memcmp(&a.planes[k][i], &b.planes[k][i], 4), 0) << x << ", " << y;
          EXPECT_TRUE(std::isfinite(a.planes[k][i]));
        }
      }
    }
}

TEST(ContrastFilter, hue_stays_and_strength_mixes_in_light) {
  ContrastParameters p = eye_at(0.01, 16);
  Picture in = wall();
  for (float& v : in.planes[0]) v *= 0.5f;
  const Picture full = test::filtered(p, in);
  p.strength = 0.25;
  const Picture quarter = test::filtered(p, in);
  for (std::size_t i = 0; i < in.planes[0].size(); ++i) {
    const float expected = in.planes[1][i] + 0.25f * (full.planes[1][i] - in.planes[1][i]);
    EXPECT_NEAR(quarter.planes[1][i], expected, 1e-5 * expected);
    // A thousandth of La goes into what becomes brighter, as grey.
    EXPECT_NEAR(full.planes[0][i], 0.5f * full.planes[1][i], 0.01 * full.planes[1][i] + 0.02);
  }
  p.strength = 0;
  EXPECT_EQ(ContrastFilter(p).halo(), 0);
  EXPECT_EQ(test::filtered(p, in).planes[0], in.planes[0]);
}

TEST(ContrastFilter, pictures_too_coarse_pass) {
  ContrastParameters p = eye_at(0.001, 7.9);
  EXPECT_EQ(ContrastFilter(p).bands(), 0);
  EXPECT_EQ(ContrastFilter(p).halo(), 0);
  const Picture in = wall();
  EXPECT_EQ(test::filtered(p, in).planes[2], in.planes[2]);
  p.pixels_per_degree = 8;
  EXPECT_EQ(ContrastFilter(p).bands(), 1);
}

TEST(ContrastFilter, refuses_what_is_outside_its_domain) {
  const auto refuses = [](auto change) {
    ContrastParameters p;
    change(p);
    EXPECT_THROW(ContrastFilter{p}, std::invalid_argument);
  };
  refuses([](auto& p) { p.adaptation = 0; });
  refuses([](auto& p) { p.unit = -1; });
  refuses([](auto& p) { p.pixels_per_degree = std::nan(""); });
  refuses([](auto& p) { p.pixels_per_degree = 1001; });
  refuses([](auto& p) { p.display.peak = 0; });
  refuses([](auto& p) { p.display.scale = std::nan(""); });
  refuses([](auto& p) { p.strength = 1.5; });
  refuses([](auto& p) { p.luminance = {0, 0, 0}; });
}

}  // namespace
}  // namespace scotopic

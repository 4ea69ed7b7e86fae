// What a display is sent: range, order, colour, and what must not break it.
#include "stages/display/local/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "adaptation/mesopic.h"
#include "stages/display/local/picture.h"

namespace scotopic::test {
namespace {

DisplayParameters parameters() {
  DisplayParameters p;
  p.adaptation = 0.05;
  p.white_luminance = 0.05 / 0.18;
  p.sigma = 3;
  p.xyz_from_rgb = p.xyz_from_gamut = rec709;
  return p;
}

DisplayParameters without_night() {
  DisplayParameters p = parameters();
  p.night_range = 1;
  return p;
}

/// One pixel's worth: a constant picture of this colour.
Vec3<double> shown(const DisplayParameters& p, const DisplayRange& range, Vec3<double> rgb) {
  Planes in(9, 9);
  for (std::size_t i = 0; i < in.size(); ++i) {
    in.r[i] = static_cast<float>(rgb[0]);
    in.g[i] = static_cast<float>(rgb[1]);
    in.b[i] = static_cast<float>(rgb[2]);
  }
  const Planes out = filtered(DisplayFilter(p, range), in);
  return {out.r[40], out.g[40], out.b[40]};
}

double shown_grey(const DisplayParameters& p, const DisplayRange& range, double luminance) {
  const double value = luminance / p.white_luminance;
  return shown(p, range, {value, value, value})[1];
}

TEST(Display, large_shapes_span_the_contrast_and_end_at_the_peak) {
  // Durand & Dorsey: base' = c (base - high), c = log 5/log(high/low). Below the shoulder nothing else
  // happens.
  const DisplayParameters p = without_night();
  const DisplayRange range = {0.01, 100};
  const double c = std::log10(5.0) / 4;
  EXPECT_NEAR(DisplayFilter(p, range).compression(), c, 1e-7);
  for (const double luminance : {0.01, 0.1, 1.0, 10.0})
    EXPECT_NEAR(shown_grey(p, range, luminance), std::pow(luminance / 100, c),
                2e-4 * std::pow(luminance / 100, c));
  EXPECT_NEAR(shown_grey(p, range, 0.01), 0.2, 1e-4);
  EXPECT_NEAR(shown_grey(p, range, 100), 0.9, 1e-4);  // on the shoulder: .8 + .2 (1 - .2/.4)
  EXPECT_LE(shown_grey(p, range, 1e9), 1.0);
}

TEST(Display, a_range_that_fits_is_shown_in_proportion) {
  const DisplayParameters p = without_night();
  EXPECT_EQ(DisplayFilter(p, {0.3, 0.9}).compression(), 1.0);
  EXPECT_NEAR(shown_grey(p, {0.3, 0.9}, 0.3), 1.0 / 3, 1e-4);
  EXPECT_NEAR(shown_grey(p, {0.3, 0.9}, 0.45), 0.5, 1e-4);
  EXPECT_NEAR(shown_grey(p, {1, 1}, 0.5), 0.5, 1e-4);
}

TEST(Display, detail_keeps_its_contrast) {
  // Stripes one pixel wide, 20 % up and down, over a step of 1000: compressed to less than 5, stripes as they
  // were.
  const Planes in(64, 32, [](int x, int) { return (x < 32 ? 0.01 : 10.0) * (x % 2 ? 1.2 : 0.8); });
  const DisplayParameters p = without_night();
  const Planes out = filtered(DisplayFilter(p, {0.001, 50}), in);
  for (const int x : {10, 50}) {
    const double ratio =
        static_cast<double>(out.g[out.at(x + 1, 16)]) / static_cast<double>(out.g[out.at(x, 16)]);
    EXPECT_NEAR(ratio, 1.5, 0.03);  // a stripe's base leans towards the stripe
  }
  const double step = static_cast<double>(out.g[out.at(50, 16)]) / static_cast<double>(out.g[out.at(10, 16)]);
  EXPECT_NEAR(std::log10(step), 3 * std::log10(5.0) / std::log10(5e4), 0.01);
}

TEST(Display, a_brighter_display_has_more_range_above_and_the_same_darks) {
  DisplayParameters p = without_night();
  const DisplayRange range = {0.01, 1000};
  const double dark = shown_grey(p, range, 0.01);
  p.peak = 1000;
  EXPECT_NEAR(shown_grey(p, range, 0.01), dark, 1e-3 * dark);
  EXPECT_GT(shown_grey(p, range, 1000), 8.9);
  EXPECT_LE(shown_grey(p, range, 1e12), 10.0);
  p.peak = 48;
  EXPECT_LE(shown_grey(p, range, 1e12), 0.48);
}

TEST(Display, night_has_its_share_of_the_range_as_the_paper_says) {
  EXPECT_EQ(night_factor(0, 0.25, 1), 1.0);
  EXPECT_EQ(night_factor(1, 0.25, 1), 0.25);
  EXPECT_EQ(night_factor(0.5, 0.25, 1), 0.625);
  EXPECT_EQ(night_factor(0.5, 0.25, 2), 0.8125);
  DisplayParameters p = parameters();
  const DisplayRange range = {0.1, 1};
  for (const double gamma : {0.25, 0.5})
    for (const double luminance : {0.0005, 0.02, 0.3, 2.0}) {
      p.adaptation = 0.001;
      p.white_luminance = 0.01;
      p.night_range = 1;
      const double full = shown_grey(p, range, luminance);
      p.night_range = gamma;
      const double w = 1 - mesopic_coefficient(p.adaptation + luminance);
      EXPECT_NEAR(shown_grey(p, range, luminance) / full, 1 - w * (1 - gamma), 1e-4) << luminance;
      p.weight = Weight::global;
      EXPECT_NEAR(shown_grey(p, range, luminance) / full, gamma, 1e-4);
      p.weight = Weight::local;
    }
}

TEST(Display, more_light_is_never_shown_darker) {
  const DisplayParameters p = parameters();
  double before = 0;
  for (double luminance = 1e-9; luminance < 1e12; luminance *= 1.05) {
    const double now = shown_grey(p, {0.003, 30}, luminance);
    EXPECT_GE(now, before * (1 - 2e-6)) << luminance;
    before = now;
  }
  EXPECT_NEAR(before, 1.0, 1e-3);
}

TEST(Display, a_grey_stays_grey) {
  for (const double luminance : {1e-4, 0.02, 1.0, 300.0}) {
    const Vec3<double> out = shown(parameters(), {0.003, 30}, {luminance, luminance, luminance});
    EXPECT_NEAR(out[0], out[1], 1e-6);
    EXPECT_NEAR(out[2], out[1], 1e-6);
  }
}

TEST(Display, nothing_leaves_the_display_s_gamut_and_chromaticity_stays_where_it_can) {
  const DisplayParameters p = without_night();
  const DisplayRange range = {0.003, 30};
  for (const Vec3<double>& rgb : {Vec3<double>{1, 0.2, 0.01},
                                  {0.01, 0.02, 0.9},
                                  {300, 20, 1},
                                  {-0.2, 0.5, 0.4},
                                  {1e-3, -1e-4, 1e-3},
                                  {1e20, 0, 1e19},
                                  {0, 0, 2e5}}) {
    const Vec3<double> out = shown(p, range, rgb);
    for (const double x : out) {
      EXPECT_GE(x, -1e-7);
      EXPECT_LE(x, 1.0 + 1e-6);
    }
  }
  const Vec3<double> dim = shown(p, range, {0.1, 0.02, 0.001});
  EXPECT_NEAR(dim[1] / dim[0], 0.2, 1e-5);
  EXPECT_NEAR(dim[2] / dim[0], 0.01, 1e-6);
}

TEST(Display, a_colour_too_bright_for_it_keeps_its_luminance_and_goes_towards_white) {
  const DisplayParameters p = without_night();
  const Vec3<double> blue = shown(p, {0.003, 30}, {0, 0, 1e4});
  EXPECT_NEAR(blue[2], 1.0, 1e-5);
  EXPECT_GT(blue[0], 0.0);
  EXPECT_NEAR(blue[0], blue[1], 1e-5);
}

TEST(Display, what_is_no_number_passes_and_harms_no_other) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  Planes in(24, 24, [](int x, int y) { return 0.1 + 0.01 * ((x * 7 + y * 3) % 5); });
  in.r[in.at(3, 4)] = nan;
  in.b[in.at(12, 12)] = infinite;
  in.g[in.at(20, 3)] = 3e38f;
  in.r[in.at(7, 20)] = in.g[in.at(7, 20)] = in.b[in.at(7, 20)] = 1e30f;
  in.r[in.at(1, 1)] = in.g[in.at(1, 1)] = in.b[in.at(1, 1)] = 0;
  const Planes out = filtered(DisplayFilter(parameters(), {0.003, 30}), in);
  EXPECT_TRUE(std::isnan(out.r[out.at(3, 4)]));
  EXPECT_EQ(out.g[out.at(3, 4)], in.g[in.at(3, 4)]);
  EXPECT_EQ(out.b[out.at(12, 12)], infinite);
  EXPECT_EQ(out.g[out.at(20, 3)], 3e38f);
  EXPECT_NEAR(out.r[out.at(7, 20)], 1.0f, 1e-3f);
  EXPECT_EQ(out.r[out.at(1, 1)], 0.0f);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      if (!(x == 3 && y == 4) && !(x == 12 && y == 12) && !(x == 20 && y == 3)) {
        EXPECT_TRUE(std::isfinite(out.r[out.at(x, y)])) << x << " " << y;
      }
}

TEST(Display, does_not_depend_on_tiles) {
  const Planes in(120, 70, [](int x, int y) { return std::exp(5 * std::sin(x / 11.0) + std::cos(y / 7.0)); });
  const DisplayFilter filter(parameters(), {0.003, 30});
  const Planes whole = filtered(filter, in);
  for (const int side : {13, 50}) {
    const Planes tiled = filtered(filter, in, side);
    EXPECT_EQ(tiled.r, whole.r);
    EXPECT_EQ(tiled.b, whole.b);
  }
}

TEST(Display, a_parameter_out_of_its_domain_is_refused) {
  const DisplayRange range = {0.1, 1};
  const auto refuses = [&](const auto& spoil) {
    DisplayParameters p = parameters();
    DisplayRange r = range;
    spoil(p, r);
    EXPECT_THROW(DisplayFilter(p, r), std::invalid_argument);
  };
  refuses([](DisplayParameters& p, DisplayRange&) { p.contrast = 0.5; });
  refuses([](DisplayParameters& p, DisplayRange&) { p.peak = 0; });
  refuses([](DisplayParameters& p, DisplayRange&) { p.night_range = 1.5; });
  refuses([](DisplayParameters& p, DisplayRange&) { p.night_exponent = std::nan(""); });
  refuses([](DisplayParameters& p, DisplayRange&) { p.adaptation = 0; });
  refuses([](DisplayParameters& p, DisplayRange&) { p.white_luminance = -1; });
  refuses([](DisplayParameters&, DisplayRange& r) { r.low = 0; });
  refuses([](DisplayParameters&, DisplayRange& r) { r.low = 2; });
  EXPECT_NO_THROW(DisplayFilter(parameters(), range));
}

}  // namespace
}  // namespace scotopic::test

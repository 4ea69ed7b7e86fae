// Rounding to 8 bits by a pixel's place.
#include "pipeline/rows/dither.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "io/pixels/pixel_type.h"
#include "pipeline/rows/row_codec.h"

namespace scotopic {
namespace {

std::vector<std::uint8_t> written(float value, int width, int y, bool dither) {
  LightRow light(static_cast<std::size_t>(width));
  for (auto* plane : {&light.r, &light.g, &light.b}) std::fill(plane->begin(), plane->end(), value);
  std::fill(light.touched.begin(), light.touched.end(), std::uint8_t{1});
  std::vector<std::uint8_t> out(static_cast<std::size_t>(3 * width));
  const auto row = [&](std::size_t c) {
    return NativeRow{reinterpret_cast<std::byte*>(out.data() + c), 3, PixelType::uint8};
  };
  LightWriter writer;
  writer.dither = dither;
  writer.write(light, {row(0), row(1), row(2)}, nullptr, 0, y);
  return out;
}

TEST(Dither, offsets_are_evenly_spread_and_below_half_a_code) {
  std::array<int, 20> count{};
  double sum = 0;
  for (int y = -128; y < 128; ++y)
    for (int x = -128; x < 128; ++x) {
      const float d = dither_of(x, y);
      ASSERT_LE(std::abs(d), 0.499f);
      sum += double{d};
      ++count[static_cast<std::size_t>((d + 0.5f) * 20)];
    }
  EXPECT_NEAR(sum / 65536, 0, 1e-3);
  for (const int n : count) EXPECT_NEAR(n, 65536 / 20, 65536 / 200);
}

TEST(Dither, neighbours_differ_so_that_the_mean_of_16_pixels_is_near_the_values) {
  for (int y = 0; y < 64; y += 4)
    for (int x = 0; x < 64; x += 4) {
      double sum = 0;
      for (int i = 0; i < 16; ++i) sum += double{dither_of(x + i % 4, y + i / 4)};
      EXPECT_LE(std::abs(sum / 16), 0.1) << x << ' ' << y;
    }
}

TEST(Dither, a_value_on_a_code_keeps_it) {
  for (int code = 0; code <= 255; ++code) {
    const std::vector<std::uint8_t> out = written(static_cast<float>(code) / 255, 64, code, true);
    EXPECT_EQ(*std::min_element(out.begin(), out.end()), code);
    EXPECT_EQ(*std::max_element(out.begin(), out.end()), code);
  }
}

TEST(Dither, the_mean_of_an_area_is_the_value) {
  for (const double code : {0.25, 3.5, 17.9, 200.1}) {
    double dithered = 0, plain = 0;
    for (int y = 0; y < 64; ++y) {
      for (const std::uint8_t v : written(static_cast<float>(code / 255), 64, y, true)) dithered += v;
      for (const std::uint8_t v : written(static_cast<float>(code / 255), 64, y, false)) plain += v;
    }
    EXPECT_NEAR(dithered / (3 * 4096), code, 0.01);
    EXPECT_EQ(plain / (3 * 4096), std::round(code));
  }
}

TEST(Dither, channels_of_a_grey_stay_equal) {
  const std::vector<std::uint8_t> out = written(0.1234f, 256, 7, true);
  for (std::size_t i = 0; i < out.size(); i += 3) {
    EXPECT_EQ(out[i], out[i + 1]);
    EXPECT_EQ(out[i], out[i + 2]);
  }
}

TEST(Dither, what_lies_beyond_the_codes_is_clipped_as_it_is) {
  const std::vector<std::uint8_t> low = written(-0.001f, 64, 0, true), high = written(1.001f, 64, 0, true);
  EXPECT_EQ(*std::max_element(low.begin(), low.end()), 0);
  EXPECT_EQ(*std::min_element(high.begin(), high.end()), 255);
}

}  // namespace
}  // namespace scotopic

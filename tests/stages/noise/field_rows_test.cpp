// The field along rows: the doubles of field_at(), on every target, for any columns and any order.
#include "stages/noise/field_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "stages/noise/pitch.h"
#include "support/simd_targets.h"

namespace scotopic::noise {
namespace {

using test::time_pitch;

Field field_of(double pitch) { return fixed_field({pitch, time_pitch, 11}); }

double reference(const Field& field, const View& view, std::int64_t x, std::int64_t y) {
  const double degrees_x = (static_cast<double>(x) + 0.5 - view.center_x) / view.pixels_per_degree;
  const double degrees_y = (static_cast<double>(y) + 0.5 - view.center_y) / view.pixels_per_degree;
  return field_at(field, degrees_x, degrees_y, view.seconds);
}

TEST(FieldRows, are_the_doubles_of_the_reference_on_every_target) {
  const View view{40, 480, 270, 7.0 / 24};
  test::on_every_target([&](const char* target) {
    for (const Field& field :
         {field_of(0.106), field_of(0.75 / 40), field_of(3), octave_field(0.11, time_pitch, 2)}) {
      FieldRows rows(field, view, -5, 67);
      for (const std::int64_t y : {-3, 0, 1, 2, 17, 16, 539}) {
        const double* n = rows.row(y);
        for (std::int64_t i = 0; i < 67; ++i) ASSERT_EQ(n[i], reference(field, view, i - 5, y)) << target;
      }
    }
  });
}

TEST(FieldRows, tiles_and_crops_show_the_same_field) {
  const View view{20, 100, 50, 0.5};
  FieldRows whole(field_of(0.1), view, 0, 200);
  for (const std::size_t width : {1u, 3u, 64u})
    for (std::size_t x0 = 0; x0 + width <= 200; x0 += width) {
      FieldRows tile(field_of(0.1), view, static_cast<std::int64_t>(x0), width);
      for (const std::int64_t y : {99, 0, 40, 41}) {
        const double* expected = whole.row(y) + x0;
        EXPECT_TRUE(std::equal(expected, expected + width, tile.row(y))) << x0 << " " << y;
      }
    }
}

TEST(FieldRows, three_resolutions_show_the_same_field) {
  // Middles of pixels of the coarse picture are middles of pixels of pictures 3 and 5 times as fine.
  FieldRows coarse(field_of(0.1), {12, 30, 20, 0.25}, 0, 60);
  for (const int times : {3, 5}) {
    FieldRows fine(field_of(0.1), {12.0 * times, 30.0 * times, 20.0 * times, 0.25}, 0,
                   60u * static_cast<unsigned>(times));
    for (std::int64_t y = 0; y < 40; ++y) {
      const double* a = coarse.row(y);
      const double* b = fine.row(y * times + times / 2);
      for (int x = 0; x < 60; ++x) ASSERT_EQ(a[x], b[x * times + times / 2]) << times << " " << x << " " << y;
    }
  }
}

// Of pixels that are nearly independent: 64 frames a second apart at the smallest pitch. Tolerances are 5
// standard errors.
TEST(FieldRows, pixels_have_mean_0_and_variance_1) {
  double sum = 0, squares = 0;
  constexpr std::size_t width = 160, height = 100;
  for (int frame = 0; frame < 64; ++frame) {
    FieldRows rows(field_of(0.75 / 20), {20, width / 2.0, height / 2.0, 1.0 * frame}, 0, width);
    for (std::size_t y = 0; y < height; ++y) {
      const double* n = rows.row(static_cast<std::int64_t>(y));
      sum = std::accumulate(n, n + width, sum);
      squares = std::inner_product(n, n + width, n, squares);
    }
  }
  constexpr double count = 64.0 * width * height;
  std::printf("rows: mean %.5f, variance %.5f over %.3g pixels\n", sum / count, squares / count, count);
  EXPECT_NEAR(sum / count, 0, 0.01);
  EXPECT_NEAR(squares / count, 1, 0.012);
}

}  // namespace
}  // namespace scotopic::noise

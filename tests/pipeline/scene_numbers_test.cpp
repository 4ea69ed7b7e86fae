#include "pipeline/scene/scene_numbers.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace scotopic {
namespace {

TEST(SceneNumbers, the_user_wins_over_the_file_and_the_file_over_the_guess) {
  KnownNumbers known;
  known.adaptation = 0.9;
  EXPECT_DOUBLE_EQ(resolve_numbers(known, 0, "f").white_luminance, 5.0);
  known.file_unit = 3;
  EXPECT_DOUBLE_EQ(resolve_numbers(known, 0, "f").white_luminance, 3.0);
  known.white_luminance = 7;
  EXPECT_DOUBLE_EQ(resolve_numbers(known, 0, "f").white_luminance, 7.0);
}

TEST(SceneNumbers, an_average_in_image_values_needs_a_unit) {
  EXPECT_THROW(needs_measurement({}, "f"), Error);
  KnownNumbers known;
  known.file_unit = 10;
  EXPECT_TRUE(needs_measurement(known, "f"));
  EXPECT_DOUBLE_EQ(resolve_numbers(known, 0.25, "f").adaptation, 2.5);
  known.adaptation = 1;
  EXPECT_FALSE(needs_measurement(known, "f"));
}

TEST(SceneNumbers, a_black_picture_adapts_to_nothing) {
  KnownNumbers known;
  known.file_unit = 10;
  EXPECT_THROW(resolve_numbers(known, 0, "f"), Error);
}

}  // namespace
}  // namespace scotopic

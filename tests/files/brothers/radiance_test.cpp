// Radiance pictures: every order of pixels, and lines that are not what they should be.
#include <gtest/gtest.h>

#include "files/brothers/table.h"

namespace scotopic {
namespace {

/// Pixels i = 1, 2, ... of i/16 in red.
std::string radiance_of(const std::string& lines, const std::string& order, int pixels) {
  std::string out = "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + order + "\n";
  for (int i = 1; i <= pixels; ++i)
    out += std::string({static_cast<char>(i * 16), 0, 0, static_cast<char>(128)});
  return out;
}

TEST(Brothers, orders_of_radiance_are_of_its_own_axes) {
  // Radiance, src/common/resolu.h: x grows to the right, y upwards; the first axis is the slow one. What
  // stands at the upper left of 3 columns and 2 rows, and to the right of it.
  struct Order {
    const char* text;
    int upper_left, right_of_it;
  };
  const std::vector<Order> orders = {{"-Y 2 +X 3", 1, 2}, {"-Y 2 -X 3", 3, 2}, {"+Y 2 -X 3", 6, 5},
                                     {"+Y 2 +X 3", 4, 5}, {"+X 3 -Y 2", 1, 3}, {"+X 3 +Y 2", 2, 4},
                                     {"-X 3 +Y 2", 6, 4}, {"-X 3 -Y 2", 5, 3}};
  for (const Order& order : orders) {
    test::write_bytes(test::place("in.hdr"), radiance_of("", order.text, 6));
    ASSERT_EQ(test::apply(test::place("in.hdr"), test::place("out.exr")).exit_code, 0) << order.text;
    EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"R"})[0], order.upper_left / 16.0, 4e-3)
        << order.text;
    EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"R"}, 0, 1, 0)[0], order.right_of_it / 16.0, 4e-3)
        << order.text;
  }
}

TEST(Brothers, lines_of_radiance) {
  const double v = 1 / 16.0;
  const std::vector<std::pair<std::string, test::Expected>> rows = {
      {"EXPOSURE=2\nEXPOSURE=4\n", {"twice", {v / 8, 0, 0}, 5e-3, "divided by its EXPOSURE"}},
      {"COLORCORR=2 1 4\n", {"of each channel", {v / 2, 0, 0}, 5e-3}},
      {" EXPOSURE=2\n", {"of an older picture's history", {v, 0, 0}, 5e-3}},
      {"EXPOSURE=nan\n", {"no number", {}, 0, "", "its EXPOSURE is not a number"}},
      {"EXPOSURE=abc\n", {"words", {}, 0, "", "its EXPOSURE is not a number"}},
      {"EXPOSURE=2,5\n", {"a comma", {}, 0, "", "its EXPOSURE is not a number"}},
      {"EXPOSURE=0\n", {"zero", {}, 0, "", "is no factor"}},
      {"COLORCORR=1 2\n", {"two", {}, 0, "", "its COLORCORR is not 3 numbers"}},
      {"PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06\n", {"six", {}, 0, "", "its PRIMARIES is not 8 numbers"}},
  };
  for (const auto& [lines, expected] : rows) {
    test::write_bytes(test::place("in.hdr"), radiance_of(lines, "-Y 1 +X 1", 1));
    test::expect_row(test::place("in.hdr"), expected);
  }
}

}  // namespace
}  // namespace scotopic

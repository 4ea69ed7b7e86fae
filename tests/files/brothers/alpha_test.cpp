// Straight and premultiplied alpha: one rule, the same light.
#include <gtest/gtest.h>

#include <cmath>

#include "files/brothers/table.h"

namespace scotopic {
namespace {

/// Of a code of 16 bits, IEC 61966-2-1.
double decoded(std::uint16_t code) { return test::srgb_light(code / 257.0); }

TEST(Brothers, straight_png_and_the_premultiplied_exr_of_it_are_the_same_night) {
  // One colour in sRGB's codes at four opacities, as PNG has it; in OpenEXR its light times alpha.
  for (const std::uint16_t alpha :
       {std::uint16_t{65535}, std::uint16_t{32768}, std::uint16_t{16384}, std::uint16_t{0}}) {
    const std::vector<std::uint16_t> rgb = {32768, 16384, 49151};
    const double a = alpha / 65535.0;
    const auto part = [&](std::size_t c) { return static_cast<float>(decoded(rgb[c]) * a); };
    test::write_bytes(test::place("in.png"), test::flat_png({rgb[0], rgb[1], rgb[2], alpha}, {}));
    test::write_flat_exr(
        test::place("in.exr"),
        {{"", {{"R", part(0)}, {"G", part(1)}, {"B", part(2)}, {"A", static_cast<float>(a)}}}});
    const std::vector<std::string> night = {"--adaptation", "0.05", "--white-luminance",
                                            "0.5",          "-d",   "float"};
    for (const char* name : {"png", "exr"})
      ASSERT_EQ(
          test::apply(test::place(std::string("in.") + name), test::place(name + std::string(".exr")), night)
              .exit_code,
          0);
    const std::vector<float> x = test::pixel_of(test::place("png.exr"), {"R", "G", "B", "A"});
    const std::vector<float> y = test::pixel_of(test::place("exr.exr"), {"R", "G", "B", "A"});
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(x[c], y[c], 1e-5) << alpha << " channel " << c;
    if (alpha == 0) continue;
    EXPECT_GT(std::abs(x[0] - part(0)), 0.001f) << "the night changed nothing";
  }
}

}  // namespace
}  // namespace scotopic

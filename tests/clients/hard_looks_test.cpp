// Whole images of hard pixels through a shipped look, by OCIO's CPU and GPU (GLSL) renderers: one bad pixel
// stays one. The operator itself on such images: tests/properties/hard_images_test.cpp.
#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "clients/host.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic::test {
namespace {

// Powers of two: where they are not, ocioconvert's texture coordinates round, and pixels mix a millionth of
// their neighbours.
constexpr int width = 256, night_rows = 64;
constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

float half_of(std::size_t bits) {
  return static_cast<float>(Imath::half(Imath::half::FromBits, static_cast<std::uint16_t>(bits % 65536)));
}

// A dim picture, and in it negative noise, lamps of one pixel, rings of NaN and infinities, and +-1e38.
Pixels night() {
  Pixels pixels;
  for (int y = 0; y < night_rows; ++y)
    for (int x = 0; x < width; ++x) {
      const auto noise = static_cast<float>((x * 7919 + y * 104729) % 97 - 48) / 4800;
      float rgb[3] = {0.01f + noise, 0.02f - noise, 0.015f + noise / 2};
      if (std::abs(std::hypot(x % 64 - 32, y - 32) - 20) < 1) {
        const float bad[4][3] = {
            {nan, 0.1f, 0.2f}, {inf, -inf, 0.1f}, {1e38f, -1e38f, 1}, {-1e38f, -1e38f, -1e38f}};
        for (int c = 0; c < 3; ++c) rgb[c] = bad[x / 64][c];
      }
      if (x % 64 == 32 && y == 32) rgb[0] = 5000, rgb[1] = 3000, rgb[2] = 1000;
      pixels.insert(pixels.end(), {rgb[0], rgb[1], rgb[2], static_cast<float>(x) / width});
    }
  return pixels;
}

// Every half in every channel, beside others.
Pixels every_half() {
  Pixels pixels;
  for (std::size_t i = 0; i < 65536; ++i)
    pixels.insert(pixels.end(), {half_of(i), half_of(i * 7919 + 3), half_of(i * 104729 + 11),
                                 static_cast<float>(i % 65) / 64});
  return pixels;
}

const std::vector<Pixels>& hard_images() {
  static const std::vector<Pixels> images = {every_half(), night()};
  return images;
}

// Of a pixel's largest component. OpenColorIO 2.1 gives the same bits for a pixel in a row and alone; 2.6,
// where some pixels of a row go through vector code, differs by up to 7e-6 in its lossless arithmetic.
constexpr float vector_code = 1e-5f;

bool finite(const float* rgb) {
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

Pixels through(const OCIO::ConstCPUProcessorRcPtr& look, Pixels pixels, int across) {
  OCIO::PackedImageDesc image(pixels.data(), across, static_cast<long>(pixels.size()) / 4 / across, 4);
  look->apply(image);
  return pixels;
}

/// Without OpenColorIO's faster arithmetic, which changes with its releases.
OCIO::ConstCPUProcessorRcPtr cpu_look(const std::string& look) {
  return config()->getProcessor(look_transform(look))->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
}

TEST(HardLooks, on_the_cpu_every_pixel_comes_out_finite_as_if_alone_and_alpha_keeps_its_bits) {
  for (const std::string& look : {street, moon})
    for (const Pixels& in : hard_images()) {
      const auto processor = cpu_look(look);
      const Pixels out = through(processor, in, width);
      int bad = 0;
      for (std::size_t i = 0; i < in.size(); i += 4) {
        bad += !finite(&in[i]);
        ASSERT_TRUE(finite(&out[i])) << look << ", pixel " << i / 4;
        ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i + 3]), std::bit_cast<std::uint32_t>(in[i + 3])) << i / 4;
        if (i % 28) continue;
        const Pixels alone = through(processor, Pixels(&in[i], &in[i] + 4), 1);
        const float size = std::max({std::abs(alone[0]), std::abs(alone[1]), std::abs(alone[2])});
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(out[i + c], alone[c], vector_code * size) << look << ", pixel " << i / 4;
      }
      EXPECT_GT(bad, 300);
    }
}

TEST(HardLooks, infinity_is_taken_for_the_largest_half_and_what_is_darker_than_black_for_no_light) {
  for (const std::string& look : {street, moon}) {
    const auto processor = cpu_look(look);
    const Pixels out =
        through(processor, {inf, 0.1f, 0.1f, 1, 65504, 0.1f, 0.1f, 1, 1e38f, 0.1f, 0.1f, 1}, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(out[c], out[4 + c], vector_code * 65504);
      EXPECT_NEAR(out[8 + c], out[4 + c], vector_code * 65504);
    }
    const Pixels dark =
        through(processor, {-inf, -inf, -inf, 1, -1e38f, -1e38f, -1e38f, 1, -1, -1, -1, 1}, 1);
    for (std::size_t i = 0; i < dark.size(); ++i) EXPECT_NEAR(dark[i], i % 4 == 3 ? 1 : 0, 1e-6) << i;
  }
}

// ocioconvert --gpu reads the picture through a bilinear texture filter: 0 times NaN is NaN, so that the
// three pixels before a bad one are bad when the look gets them.
bool sound_to_the_filter(const Pixels& in, std::size_t pixel) {
  const std::size_t rows = in.size() / 4 / width, x = pixel % width, y = pixel / width;
  for (const std::size_t at_y : {y, std::min(y + 1, rows - 1)})
    for (const std::size_t at_x : {x, std::min<std::size_t>(x + 1, width - 1)})
      if (!finite(&in[4 * (at_y * width + at_x)])) return false;
  return true;
}

void expect_the_gpu_to_follow(const std::string& look, const Pixels& in) {
  const std::string file = work_folder() + "/hard.exr", seen = work_folder() + "/hard_gpu.exr";
  write_pixels(file, in, width);
  const Finished result = run("export OCIO=" + quoted(config_file()) +
                              "; LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a ocioconvert --gpu " + quoted(file) +
                              " " + quoted(linear) + " " + quoted(seen) + " " + quoted(look));
  ASSERT_EQ(result.exit_code, 0) << result.said;
  const Pixels got = read_pixels(seen), cpu = through(cpu_look(look), in, width);
  ASSERT_EQ(got.size(), in.size());
  double worst = 0;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < in.size(); i += 4) {
    ASSERT_EQ(got[i + 3], in[i + 3]) << "alpha of pixel " << i / 4;
    ASSERT_TRUE(finite(&got[i])) << look << ", pixel " << i / 4;
    if (!sound_to_the_filter(in, i / 4)) continue;
    ++compared;
    double size = 1e-6, difference = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      size = std::max(size, std::abs(static_cast<double>(cpu[i + c])));
      difference =
          std::max(difference, std::abs(static_cast<double>(got[i + c]) - static_cast<double>(cpu[i + c])));
    }
    worst = std::max(worst, difference / size);
  }
  std::printf("%s: GPU against CPU on %zu hard pixels, worst %.3g\n", look.c_str(), compared, worst);
  EXPECT_LE(worst, 1e-4);
  EXPECT_GT(compared, in.size() / 4 / 2);
}

TEST(HardLooks, on_the_gpu_too_and_what_the_texture_filter_leaves_sound_is_the_cpu_s) {
  NEEDS("ocioconvert");
  NEEDS("xvfb-run");
  for (const std::string& look : {street, moon})
    for (const Pixels& in : hard_images()) expect_the_gpu_to_follow(look, in);
}

}  // namespace
}  // namespace scotopic::test

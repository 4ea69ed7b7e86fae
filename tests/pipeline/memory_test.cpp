// Images in memory: what a file with the same pixels becomes, in any piece of the frame. Types, strides and
// stages against the program: tests/python.
#include "pipeline/memory/run_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "base/error.h"
#include "support/exr_files.h"

namespace scotopic {
namespace {

using test::read_bits;
using test::temporary;
using test::TestPart;
using test::write_exr;

constexpr int frame_width = 320, frame_height = 200;

ImageSettings memory_settings(bool neighbours = false) {
  ImageSettings out(ColourConfig::own());
  out.choice.adaptation = 0.05;
  out.choice.white_luminance = 1;
  out.viewing.pixels_per_degree = 20;
  out.choice.stages.set_effects(neighbours ? "shift,chroma,detail,glare" : "shift,chroma");
  if (neighbours) out.choice.stages.set("detail", "bilateral");
  set_primaries(out.choice, out.config);
  out.choice.stages.set_pixel_stages(out.choice.parameters);
  add_stages(out);
  return out;
}

std::vector<float> night(int channels) {
  std::mt19937 random(7);
  std::lognormal_distribution<float> light(-2.5f, 1.5f);
  std::vector<float> out(static_cast<std::size_t>(frame_width * frame_height * channels));
  for (float& value : out) value = light(random);
  return out;
}

MemoryPixels pixels_over(std::vector<float>& values, int w, int h, int channels) {
  MemoryPixels out;
  out.data = reinterpret_cast<std::byte*>(values.data());
  out.width = w;
  out.height = h;
  out.channels = channels;
  out.channel_stride = sizeof(float);
  out.pixel_stride = channels * out.channel_stride;
  out.row_stride = w * out.pixel_stride;
  return out;
}

void run_in_memory(const MemoryJob& job, const ImageSettings& s) {
  ExactEvaluators evaluators;
  (void)run_image(job, s, evaluators, {});
}

/// `window` of the whole frame.
std::vector<float> made(std::vector<float>& in, int channels, const Window& window, const ImageSettings& s) {
  MemoryJob job;
  job.in = pixels_over(in, frame_width, frame_height, channels);
  job.header.data = job.header.display = {0, 0, frame_width, frame_height};
  std::vector<float> out(static_cast<std::size_t>(window.width() * window.height() * channels), -1.0f);
  job.out = pixels_over(out, window.width(), window.height(), channels);
  job.window = window;
  run_in_memory(job, s);
  return out;
}

TEST(Memory, an_image_becomes_what_a_file_of_its_pixels_becomes) {
  TestPart part;
  part.channels = {{"B", PixelType::float32}, {"G", PixelType::float32}, {"R", PixelType::float32}};
  part.finite = true;
  part.data = part.display = {0, 0, frame_width, frame_height};
  const std::string in = temporary("memory_in.exr"), out = temporary("memory_out.exr");
  write_exr(in, {part});
  std::vector<float> rgb(static_cast<std::size_t>(frame_width * frame_height * 3));
  for (std::size_t c = 0; c < 3; ++c) {
    const auto bits = read_bits(in, 0, 0, 0, std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < bits.size(); ++i) std::memcpy(&rgb[3 * i + c], &bits[i], sizeof(float));
  }
  const ImageSettings s = memory_settings(true);
  ExactEvaluators evaluators;
  ImageJob job;
  job.input = in;
  job.output = out;
  (void)run_image(job, s, evaluators, {});
  const std::vector<float> seen = made(rgb, 3, {0, 0, frame_width, frame_height}, s);
  std::size_t changed = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto bits = read_bits(out, 0, 0, 0, std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < bits.size(); ++i) {
      ASSERT_EQ(std::memcmp(&seen[3 * i + c], &bits[i], sizeof(float)), 0) << "RGB"[c] << " of pixel " << i;
      changed += std::memcmp(&seen[3 * i + c], &rgb[3 * i + c], sizeof(float)) != 0;
    }
  }
  EXPECT_GT(changed, 1000u);
}

TEST(Memory, a_window_gets_its_pixels_of_the_whole_and_what_lies_outside_stays) {
  std::vector<float> in = night(4);
  const ImageSettings s = memory_settings(true);
  const std::vector<float> whole = made(in, 4, {0, 0, frame_width, frame_height}, s);
  for (const Window& window : {Window{0, 0, 1, 1}, Window{20, 30, 77, 41}, Window{-5, -4, 8, 9},
                               Window{140, 80, 160, 100}, Window{200, 0, 210, 5}}) {
    const std::vector<float> part = made(in, 4, window, s);
    for (int y = window.y0; y < window.y1; ++y)
      for (int x = window.x0; x < window.x1; ++x)
        for (int c = 0; c < 4; ++c) {
          const bool inside = x >= 0 && x < frame_width && y >= 0 && y < frame_height;
          const float expected =
              inside ? whole[static_cast<std::size_t>((y * frame_width + x) * 4 + c)] : -1.0f;
          const std::size_t at =
              static_cast<std::size_t>(((y - window.y0) * window.width() + x - window.x0) * 4 + c);
          ASSERT_EQ(part[at], expected) << x << ", " << y << ", " << c;
        }
  }
}

TEST(Memory, a_piece_of_a_frame_without_neighbours_is_that_piece_of_the_whole) {
  std::vector<float> in = night(3);
  const ImageSettings s = memory_settings();
  const std::vector<float> whole = made(in, 3, {0, 0, frame_width, frame_height}, s);
  MemoryJob job;
  job.header.data = job.window = {30, 20, 95, 61};
  job.header.display = {0, 0, frame_width, frame_height};
  const MemoryPixels all = pixels_over(in, frame_width, frame_height, 3);
  job.in = all;
  job.in.data = all.at(30, 20, 0);
  job.in.width = 65;
  job.in.height = 41;
  std::vector<float> out(static_cast<std::size_t>(65 * 41 * 3));
  job.out = pixels_over(out, 65, 41, 3);
  run_in_memory(job, s);
  for (int y = 0; y < 41; ++y)
    for (int i = 0; i < 65 * 3; ++i)
      ASSERT_EQ(out[static_cast<std::size_t>(y * 65 * 3 + i)],
                whole[static_cast<std::size_t>(((y + 20) * frame_width + 30) * 3 + i)]);
}

TEST(Memory, an_output_that_overlaps_the_input_elsewhere_or_does_not_fit_is_refused) {
  std::vector<float> in = night(3);
  MemoryJob job;
  job.in = pixels_over(in, frame_width, frame_height - 1, 3);
  job.header.data = job.header.display = job.window = {0, 0, frame_width, frame_height - 1};
  job.out = job.in;
  job.out.data = job.in.at(0, 1, 0);
  EXPECT_THROW(run_in_memory(job, memory_settings()), Error);
  job.out = job.in;
  job.out.height = 5;
  EXPECT_THROW(run_in_memory(job, memory_settings()), Error);
  job.out = job.in;
  EXPECT_NO_THROW(run_in_memory(job, memory_settings()));
}

ImageSettings detail_at(double pixels_per_degree) {
  ImageSettings s = memory_settings();
  s.viewing.pixels_per_degree = pixels_per_degree;
  s.choice.stages.set_effects("shift,detail");
  s.choice.stages.set("detail", "bilateral");
  add_stages(s);
  return s;
}

int halo_of(const ImageSettings& s) {
  StageScene scene;
  scene.parameters = parameters_of(s.choice, 0.05, 1);
  scene.resolution.pixels_per_degree = *s.viewing.pixels_per_degree;
  scene.resolution.known = true;
  return s.filter_stages.front()->make(scene, {})->halo();
}

/// Pixels from a place of the whole on.
MemoryPixels piece(std::vector<float>& whole, const Window& w) {
  MemoryPixels out = pixels_over(whole, frame_width, frame_height, 4);
  out.data = out.at(w.x0, w.y0, 0);
  out.width = w.width();
  out.height = w.height();
  return out;
}

// By either engine of the filter: one has a grid, which lies as it does on the whole.
TEST(Memory, a_tile_with_its_halo_becomes_that_piece_of_the_whole) {
  const Window all{0, 0, frame_width, frame_height};
  for (const double ppd : {30.0, 80.0}) {
    const ImageSettings s = detail_at(ppd);
    std::vector<float> in = night(4), out(in.size());
    const std::vector<float> whole = made(in, 4, all, s);
    EXPECT_NE(whole, in);
    const int halo = halo_of(s);
    for (const Window& wanted : {Window{60, 40, 70, 50}, Window{0, 0, 9, 7},
                                 Window{frame_width - 10, frame_height - 10, frame_width, frame_height}}) {
      MemoryJob job;
      job.header.data = {std::max(0, wanted.x0 - halo), std::max(0, wanted.y0 - halo),
                         std::min(frame_width, wanted.x1 + halo), std::min(frame_height, wanted.y1 + halo)};
      ASSERT_FALSE(job.header.data == all) << halo;
      job.header.display = all;
      job.header.whole = all;
      job.window = wanted;
      job.in = piece(in, job.header.data);
      job.out = piece(out, wanted);
      run_in_memory(job, s);
      for (int y = wanted.y0; y < wanted.y1; ++y) {
        const auto at = static_cast<std::size_t>(4 * (y * frame_width + wanted.x0));
        ASSERT_EQ(std::memcmp(&out[at], &whole[at], 16 * static_cast<std::size_t>(wanted.width())), 0)
            << ppd << " pixels per degree, halo " << halo << ", row " << y;
      }
    }
  }
}

}  // namespace
}  // namespace scotopic

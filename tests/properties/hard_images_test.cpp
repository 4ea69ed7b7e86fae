// Whole images of hard pixels through the operator and the acuity filter: one bad pixel stays one bad pixel.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "stages/acuity/filter.h"
#include "pipeline/apply_image.h"
#include "base/error.h"
#include "pipeline/rows/non_finite.h"
#include "properties/regimes.h"

namespace scotopic::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

struct Image {
  int width, height;
  std::array<std::vector<float>, 3> planes;
  Image(int w, int h) : width(w), height(h) {
    for (auto& plane : planes) plane.resize(static_cast<std::size_t>(w * h));
  }
  std::size_t size() const { return planes[0].size(); }
  void set(std::size_t i, float r, float g, float b) { planes[0][i] = r, planes[1][i] = g, planes[2][i] = b; }
  bool finite(std::size_t i) const {
    return std::isfinite(planes[0][i]) && std::isfinite(planes[1][i]) && std::isfinite(planes[2][i]);
  }
  std::array<std::uint32_t, 3> bits(std::size_t i) const {
    return {std::bit_cast<std::uint32_t>(planes[0][i]), std::bit_cast<std::uint32_t>(planes[1][i]),
            std::bit_cast<std::uint32_t>(planes[2][i])};
  }
};

constexpr std::array<const char*, 3> channels = {"R", "G", "B"};

template <typename Plane>
Imf::FrameBuffer frame_of(std::array<Plane, 3>& planes, int width) {
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c)
    frame.insert(channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[c].data()), sizeof(float),
                                         sizeof(float) * static_cast<std::size_t>(width)));
  return frame;
}

void write(const std::string& file, Image image) {
  Imf::Header header(image.width, image.height);
  for (const char* name : channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame_of(image.planes, image.width));
  out.writePixels(image.height);
}

Image read(const std::string& file) {
  Imf::InputFile in(file.c_str());
  const auto window = in.header().dataWindow();
  Image image(window.max.x + 1, window.max.y + 1);
  in.setFrameBuffer(frame_of(image.planes, image.width));
  in.readPixels(0, window.max.y);
  return image;
}

/// An image through files, as apply does; sigma of the acuity filter in pixels, 0: none. `found`: what was
/// reported.
Image applied(const Image& image, double sigma = 0, NonFinite policy = NonFinite::keep,
              NonFinitePixels* found = nullptr) {
  const auto folder = std::filesystem::temp_directory_path() / ("hard-images-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string in = (folder / "in.exr").string(), out = (folder / "out.exr").string();
  write(in, image);
  {
    const ColourConfig config = ColourConfig::own();
    OutputFile file(out);
    const auto source = open_source(in, Limits());
    const ImageLayout layout = plan_layout(*source, out, config, {});
    AppearanceParameters p;
    p.adaptation = 0.02;
    p.white_luminance = 0.02 / 0.18;
    p.xyz_from_rgb = config.xyz_from_working();
    p.xyz_from_gamut = config.xyz_from_working();
    AcuityParameters acuity;
    acuity.sigma = sigma;
    acuity.xyz_from_rgb = p.xyz_from_rgb;
    const AcuityFilter filter(acuity);
    const Evaluator evaluator("float", p, Precision::single);
    ImageStages stages;
    stages.non_finite = policy;
    stages.evaluator = &evaluator;
    if (sigma > 0) stages.filters.push_back(&filter);
    const NonFinitePixels passed = apply_image(*source, layout, config, stages, file);
    if (found) {
      *found = passed;
      EXPECT_EQ(measure_light(*source, layout, config, p, {}).non_finite.count, passed.count);
    }
  }
  Image result = read(out);
  std::filesystem::remove_all(folder);
  return result;
}

/// A dim picture with a gradient and some texture.
Image night(int width, int height) {
  Image image(width, height);
  Random random(3);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto level =
        static_cast<float>(0.05 + random.uniform(0, 0.2) + 0.002 * static_cast<double>(i % 97));
    image.set(i, level, 0.8f * level, static_cast<float>(random.uniform(0, 0.3)));
  }
  return image;
}

/// Pixel numbers of a ring around the middle.
std::vector<std::size_t> ring(const Image& image) {
  std::vector<std::size_t> out;
  const double x0 = image.width / 2.0, y0 = image.height / 2.0, radius = image.width / 4.0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (std::abs(std::hypot(x - x0, y - y0) - radius) < 1)
        out.push_back(static_cast<std::size_t>(y * image.width + x));
  return out;
}

Image with_ring(Image image, float value) {
  for (const std::size_t i : ring(image)) image.set(i, i % 2 ? value : 0.1f, value, 0.2f);
  return image;
}

TEST(HardImages, a_ring_of_bad_pixels_keeps_its_bits_and_touches_no_other) {
  for (const double sigma : {0.0, 2.5, 9.0}) {
    const Image reference = with_ring(night(61, 47), nan), result = applied(reference, sigma);
    for (const float bad : {inf, -inf, std::bit_cast<float>(0x7fa12345u)}) {
      const Image in = with_ring(night(61, 47), bad), out = applied(in, sigma);
      for (std::size_t i = 0; i < in.size(); ++i) {
        if (in.finite(i)) {
          ASSERT_TRUE(out.finite(i)) << "sigma " << sigma << " pixel " << i;
          ASSERT_EQ(out.bits(i), result.bits(i))
              << "sigma " << sigma << ": what a bad pixel holds shows at " << i;
        } else {
          ASSERT_EQ(out.bits(i), in.bits(i)) << "sigma " << sigma << " pixel " << i;
        }
      }
    }
  }
}

TEST(HardImages, without_acuity_pixels_beside_bad_ones_are_as_in_a_sound_picture) {
  const Image in = with_ring(night(61, 47), nan), out = applied(in), sound = applied(night(61, 47));
  int compared = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (!in.finite(i)) continue;
    ASSERT_EQ(out.bits(i), sound.bits(i)) << i;
    ++compared;
  }
  EXPECT_GT(compared, 2000);
}

TEST(HardImages, bad_pixels_are_counted_and_the_first_is_named) {
  NonFinitePixels found;
  Image in = night(61, 47);
  applied(in, 0, NonFinite::keep, &found);
  EXPECT_EQ(found.count, 0u);
  in.set(61 * 7 + 5, 1, nan, 1);
  in.set(61 * 30 + 2, -inf, 1, 1);
  applied(in, 0, NonFinite::keep, &found);
  EXPECT_EQ(describe(found), "2 pixels are not finite, the first at (5, 7)");
}

TEST(HardImages, cleaned_pixels_are_as_if_their_bad_components_had_been_0) {
  Image in = night(61, 47), zeroed = in;
  for (const std::size_t i : ring(in)) {
    in.set(i, i % 2 ? inf : 0.1f, nan, 0.2f);
    zeroed.set(i, i % 2 ? 0.0f : 0.1f, 0, 0.2f);
  }
  for (const double sigma : {0.0, 2.5}) {
    const Image out = applied(in, sigma, NonFinite::clean), expected = applied(zeroed, sigma);
    for (std::size_t i = 0; i < in.size(); ++i) ASSERT_EQ(out.bits(i), expected.bits(i)) << i;
  }
}

TEST(HardImages, a_file_with_a_bad_pixel_can_be_refused) {
  Image in = night(61, 47);
  EXPECT_NO_THROW(applied(in, 0, NonFinite::error));
  in.set(61 * 46 + 60, 1, 1, -inf);
  try {
    applied(in, 0, NonFinite::error);
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input);
    EXPECT_STREQ(error.what(), "1 pixel is not finite, the first at (60, 46)");
  }
}

TEST(HardImages, every_half_value_in_every_channel_stays_what_it_can) {
  // 65536 halves in R; G and B hold others, so that each value meets others.
  Image image(256, 256);
  const auto value = [](std::size_t h) {
    const half x(half::FromBits, static_cast<std::uint16_t>(h));
    return static_cast<float>(x);
  };
  for (std::size_t i = 0; i < image.size(); ++i)
    image.set(i, value(i), value((i * 7919 + 3) % 65536), value((i * 104729 + 11) % 65536));
  for (const double sigma : {0.0, 3.0}) {
    const Image out = applied(image, sigma);
    int bad = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      bad += !image.finite(i);
      ASSERT_TRUE(image.finite(i) ? out.finite(i) : out.bits(i) == image.bits(i)) << i;
    }
    EXPECT_GT(bad, 4000);
  }
}

TEST(HardImages, huge_negative_and_noisy_pixels_stay_finite_and_leave_the_far_away_alone) {
  const Image plain = night(61, 47), sound = applied(plain, 2.0);
  for (const auto& hard :
       {std::array{3e38f, 1.0f, 1.0f}, std::array{-3e38f, -3e38f, -3e38f}, std::array{1e30f, -1e30f, 1e-40f},
        std::array{-0.01f, 0.02f, -0.03f}, std::array{1e6f, 1e6f, 1e6f}}) {
    Image in = plain;
    const std::size_t where = 20 * 61 + 30;
    in.set(where, hard[0], hard[1], hard[2]);
    const Image out = applied(in, 2.0);
    for (std::size_t i = 0; i < in.size(); ++i) {
      ASSERT_TRUE(out.finite(i)) << i;
      const auto dx = static_cast<int>(i % 61) - 30, dy = static_cast<int>(i / 61) - 20;
      const bool far = dx * dx + dy * dy > 20 * 20;
      ASSERT_TRUE(!far || out.bits(i) == sound.bits(i)) << i;
    }
  }
}

TEST(HardImages, a_lamp_of_one_pixel_stays_a_lamp_and_lifts_no_neighbour) {
  Image in = night(61, 47);
  const std::size_t where = 20 * 61 + 30;
  in.set(where, 5000, 3000, 1000);
  const Image out = applied(in, 2.5), without = applied(night(61, 47), 2.5);
  EXPECT_EQ(out.bits(where), in.bits(where)) << "photopic, and unlike all around it";
  for (const std::size_t beside : {where - 1, where + 1, where - 61, where + 61})
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(out.planes[c][beside], without.planes[c][beside],
                  0.05f * without.planes[c][beside] + 0.01f);
}

}  // namespace
}  // namespace scotopic::test

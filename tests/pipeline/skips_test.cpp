// Pixels that are adapted to 5 cd/m2 or more are skipped piece by piece: the file is the same, bit for bit,
// as if each pixel had been looked at by itself - whatever the tiles, and however many threads.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "batch/batch.h"
#include "support/exr_files.h"
#include "io/pixels/pixel_type.h"

namespace scotopic {
namespace {

constexpr int row_width = 1301, row_count = 83;  // more than two pieces, and a rest
constexpr std::size_t pixel_count = std::size_t{row_width} * row_count;

struct Halves {
  std::vector<std::uint16_t> plane[3];
  Halves() {
    for (auto& p : plane) p.resize(pixel_count);
  }
  NativeRow row(std::size_t c) { return {reinterpret_cast<std::byte*>(plane[c].data()), 2, PixelType::half}; }
};

/// Dark ground with everything that a piece can be: lit from end to end, lit but for one pixel, dark but for
/// one, on either side of the limit by a half's last place, and pixels that are no light.
Halves scene() {
  std::mt19937 random(3);
  std::vector<float> rgb[3];
  for (auto& plane : rgb) plane.resize(pixel_count);
  for (std::size_t i = 0; i < pixel_count; ++i) {
    const std::size_t x = i % row_width, y = i / row_width;
    const bool lit = y % 4 == 1 ? true : y % 4 == 2 ? x % 512 < 200 : y % 4 == 3 ? x == 700 : false;
    const bool odd_one_out = y % 8 == 1 && x == 1000;
    const float level = lit && !odd_one_out ? 20.0f : 0.001f * static_cast<float>(random() % 1000);
    for (auto& plane : rgb) plane[i] = level * (0.5f + static_cast<float>(random() % 1000) / 2000);
    // Greys around what makes 5 cd/m2 with La = 4.5 and .01.
    const float step = static_cast<float>(x) - 650;
    for (auto& plane : rgb)
      plane[i] = y == 8 ? 0.5f + 0.0005f * step : y == 12 ? 4.99f + 0.004f * step : plane[i];
    if (y == 16 && x % 97 == 5) rgb[x % 3][i] = x % 2 ? NAN : -INFINITY;
    if (y == 17 && x % 197 == 5) rgb[x % 3][i] = x % 2 ? NAN : INFINITY;
  }
  Halves out;
  for (std::size_t c = 0; c < 3; ++c) store_row(rgb[c].data(), pixel_count, out.row(c));
  return out;
}

void write_scene(Halves& image, const std::string& file, unsigned tile) {
  Imf::Header header(row_width, row_count);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string name(1, "RGB"[c]);
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    frame.insert(name,
                 Imf::Slice(Imf::HALF, reinterpret_cast<char*>(image.plane[c].data()), 2, 2 * row_width));
  }
  if (tile == 0) {
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(frame);
    out.writePixels(row_count);
    return;
  }
  header.setTileDescription(Imf::TileDescription(tile, tile));
  Imf::TiledOutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame);
  out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
}

/// Each pixel by itself, through the operator that run_operator() uses.
Halves pixel_by_pixel(Halves in, double adaptation, std::size_t& untouched) {
  AppearanceParameters p;
  p.adaptation = adaptation;
  p.white_luminance = 1;
  p.xyz_from_rgb = ColourConfig::own().xyz_from_working();
  p.xyz_from_gamut = p.xyz_from_rgb;
  const AppearanceBatch batch(p);
  std::vector<float> rgb[3];
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c].resize(pixel_count);
    load_row(in.row(c), pixel_count, rgb[c].data());
  }
  Halves out = in;
  untouched = 0;
  for (std::size_t i = 0; i < pixel_count; ++i) {
    PixelRows one;
    one.r = &rgb[0][i], one.g = &rgb[1][i], one.b = &rgb[2][i], one.count = 1;
    std::uint8_t touched = 0;
    batch.apply(one, &touched);
    untouched += touched == 0;
    for (std::size_t c = 0; c < 3 && touched; ++c)
      store_row(&rgb[c][i], 1, {reinterpret_cast<std::byte*>(&out.plane[c][i]), 2, PixelType::half});
  }
  return out;
}

class Skips : public testing::TestWithParam<unsigned> {};

TEST_P(Skips, are_the_bits_of_every_pixel_by_itself) {
  Halves in = scene();
  const std::string file = test::temporary("skips_in.exr"), seen = test::temporary("skips_out.exr");
  write_scene(in, file, GetParam());
  for (const double adaptation : {0.01, 4.5, 4.999, 5.0, 5.001}) {
    std::size_t untouched = 0;
    const Halves expected = pixel_by_pixel(in, adaptation, untouched);
    EXPECT_GT(untouched, pixel_count / 4);
    EXPECT_EQ(untouched == pixel_count, adaptation >= 5);
    for (const int threads : {1, 2, 5}) {
      set_threads(threads);
      test::run_operator(file, seen, adaptation);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::vector<std::uint32_t> got = test::read_bits(seen, 0, 0, 0, std::string(1, "RGB"[c]));
        EXPECT_TRUE(std::equal(got.begin(), got.end(), expected.plane[c].begin(), expected.plane[c].end()))
            << "La " << adaptation << ", tiles of " << GetParam() << ", " << threads << " threads, channel "
            << c;
      }
    }
  }
  set_threads(0);
}

INSTANTIATE_TEST_SUITE_P(Tiles, Skips, testing::Values(0u, 16u, 64u, 256u, 1301u));

}  // namespace
}  // namespace scotopic

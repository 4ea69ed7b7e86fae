// Where pixels are: orientation, order of rows, exposure; and metadata that spoke of other pixels.
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfPreviewImage.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledRgbaFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "files/made_files.h"
#include "support/file_bytes.h"

namespace scotopic {
namespace {

using test::bytes_of;

/// 3 x 2 pixels of red 0.1 to 0.6, row by row; with an orientation.
void write_six(const std::string& file, int orientation) {
  OIIO::ImageSpec spec(3, 2, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("Orientation", orientation);
  std::vector<float> pixels;
  for (int i = 1; i <= 6; ++i) pixels.insert(pixels.end(), {0.1f * static_cast<float>(i), 0, 0});
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
              out->close());
}

TEST(Geometry, a_picture_is_turned_as_its_orientation_has_it) {
  // CIPA DC-008, 4.6.5: what the rows of 1 2 3 / 4 5 6 look like upright.
  const std::vector<std::vector<std::vector<int>>> upright = {
      {{1, 2, 3}, {4, 5, 6}},   {{3, 2, 1}, {6, 5, 4}},   {{6, 5, 4}, {3, 2, 1}},   {{4, 5, 6}, {1, 2, 3}},
      {{1, 4}, {2, 5}, {3, 6}}, {{4, 1}, {5, 2}, {6, 3}}, {{6, 3}, {5, 2}, {4, 1}}, {{3, 6}, {2, 5}, {1, 4}}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    write_six(test::place("in.tif"), orientation);
    const test::Run done = test::apply(test::place("in.tif"), test::place("out.exr"));
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_EQ(done.err.find("upright") != std::string::npos, orientation > 1) << done.err;
    const auto& rows = upright[static_cast<std::size_t>(orientation - 1)];
    for (std::size_t y = 0; y < rows.size(); ++y)
      for (std::size_t x = 0; x < rows[y].size(); ++x)
        EXPECT_NEAR(
            test::pixel_of(test::place("out.exr"), {"R"}, 0, static_cast<int>(x), static_cast<int>(y))[0],
            0.1 * rows[y][x], 1e-6)
            << orientation << " at " << x << ", " << y;
  }
}

/// 2 x 2 pixels 1 2 / 3 4 of a quarter of red; 8-bit mantissas of exponent 128: value m/256.
std::string radiance_of_four(const std::string& lines, const std::string& order) {
  std::string out = "#?RADIANCE\n" + lines + "\n" + order + "\n";
  for (int i = 1; i <= 4; ++i) out += std::string({static_cast<char>(i * 32), 0, 0, static_cast<char>(128)});
  return out;
}

TEST(Geometry, rows_of_radiance_come_in_any_order) {
  const std::vector<std::pair<std::string, std::vector<int>>> orders = {{"-Y 2 +X 2", {1, 2, 3, 4}},
                                                                        {"+Y 2 +X 2", {3, 4, 1, 2}},
                                                                        {"-Y 2 -X 2", {2, 1, 4, 3}},
                                                                        {"+X 2 -Y 2", {1, 3, 2, 4}}};
  for (const auto& [order, wanted] : orders) {
    test::write_bytes(test::place("in.hdr"), radiance_of_four("FORMAT=32-bit_rle_rgbe\n", order));
    const test::Run done = test::apply(test::place("in.hdr"), test::place("out.exr"));
    ASSERT_EQ(done.exit_code, 0) << order << done.err;
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"R"}, 0, i % 2, i / 2)[0],
                  wanted[static_cast<std::size_t>(i)] / 8.0, 3e-3)
          << order << i;
  }
}

TEST(Geometry, exposure_of_radiance_is_undone) {
  test::write_bytes(test::place("in.hdr"),
                    radiance_of_four("EXPOSURE=0.5\nEXPOSURE=0.5\nFORMAT=32-bit_rle_rgbe\n", "-Y 2 +X 2"));
  ASSERT_EQ(test::apply(test::place("in.hdr"), test::place("out.exr")).exit_code, 0);
  EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"R"})[0], 4 / 8.0, 1e-2);
}

TEST(Geometry, primaries_and_xyz_of_radiance_are_understood) {
  test::write_bytes(
      test::place("in.hdr"),
      radiance_of_four("PRIMARIES=0.64 0.33 0.21 0.71 0.15 0.06 0.3127 0.3290\nFORMAT=32-bit_rle_rgbe\n",
                       "-Y 2 +X 2"));
  const std::vector<std::string> in_709 = {"--output-colorspace", "Linear Rec.709 (sRGB)"};
  ASSERT_EQ(test::apply(test::place("in.hdr"), test::place("out.exr"), in_709).exit_code, 0);
  // Adobe RGB's red in BT.709: 1.39836 times as bright, and no green or blue.
  EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"R"})[0], 1.39836 / 8, 3e-3);
}

TEST(Geometry, xyz_of_radiance_is_cie_xyz) {
  // D65's white of Y 1/4 in pixel 1; whatever primaries are stated have no say; exposure and order do.
  const std::string head =
      "EXPOSURE=0.5\nFORMAT=32-bit_rle_xyze\nPRIMARIES=0.64 0.33 0.21 0.71 0.15 0.06 0.3127 0.3290\n";
  const std::vector<std::pair<std::string, int>> orders = {{"-Y 1 +X 2", 0}, {"-Y 1 -X 2", 1}};
  for (const auto& [order, at] : orders) {
    // Mantissas of exponent 128: n/256.
    test::write_bytes(test::place("in.hdr"), "#?RADIANCE\n" + head + "\n" + order + "\n" +
                                                 std::string({61, 64, 70, '\x80', 0, 0, 0, 0}));
    const test::Run done = test::apply(test::place("in.hdr"), test::place("out.exr"), {"-d", "float"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.err.find("CIE XYZ"), std::string::npos) << done.err;
    // Twice the light; white within the steps of an 8-bit mantissa.
    for (const float v : test::pixel_of(test::place("out.exr"), {"R", "G", "B"}, 0, at))
      EXPECT_NEAR(v, 0.5, 0.008);
  }
}

TEST(Geometry, tiles_of_any_compression_and_all_levels_are_written) {
  for (const Imf::Compression c : {Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION,
                                   Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION, Imf::ZIP_COMPRESSION})
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
      {
        Imf::TiledRgbaOutputFile out(test::place("in.exr").c_str(), 64, 48, 32, 32, mode, Imf::ROUND_DOWN,
                                     Imf::WRITE_RGB, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, c);
        const std::vector<Imf::Rgba> pixels(64 * 48, Imf::Rgba(0.5f, 0.25f, 0.125f));
        out.setFrameBuffer(pixels.data(), 1, 64);
        for (int level = 0; level < out.numLevels(); ++level)
          out.writeTiles(0, out.numXTiles(level) - 1, 0, out.numYTiles(level) - 1, level);
      }
      const test::Run done = test::apply(test::place("in.exr"), test::place("out.exr"));
      ASSERT_EQ(done.exit_code, 0) << c << " " << mode << done.err;
      EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"G"}, 0, 20, 20)[0], 0.25f, 2e-3f) << c;
    }
}

/// Half a picture bright, half dark in steps of 2 CIELAB units or so, turned by `roll` columns; of pixels
/// `aspect` wide.
void write_stripes(const std::string& file, int roll, float aspect, bool panorama, bool across) {
  constexpr int w = 96, h = 96;
  Imf::Header header(w, h, aspect);
  header.insert("whiteLuminance", Imf::FloatAttribute(0.05f));
  if (panorama) Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  std::vector<Imf::Rgba> pixels;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int at = across ? (x + roll) % w : y;
      const float v =
          0.2f + 0.01f * static_cast<float>(at % 8 < 4 ? 1 : 0) + 0.02f * static_cast<float>(at % 5);
      pixels.emplace_back(v, v, v);
    }
  Imf::RgbaOutputFile out(file.c_str(), header, Imf::WRITE_RGB);
  out.setFrameBuffer(pixels.data(), 1, w);
  out.writePixels(h);
}

const std::vector<std::string> blurred = {"--adaptation", "0.01", "--effects", "acuity", "--acuity",
                                          "--ppd",        "8",    "-d",        "float"};

TEST(Geometry, a_panorama_has_no_seam) {
  write_stripes(test::place("a.exr"), 0, 1, true, true);
  write_stripes(test::place("b.exr"), 48, 1, true, true);
  std::vector<std::string> more = blurred;
  *(std::find(more.begin(), more.end(), "--ppd") + 1) = "30";
  for (const char* name : {"a", "b"})
    ASSERT_EQ(test::apply(test::place(std::string(name) + ".exr"),
                          test::place(std::string(name) + "_out.exr"), more)
                  .exit_code,
              0);
  for (int x = 0; x < 96; ++x)
    EXPECT_EQ(test::pixel_of(test::place("a_out.exr"), {"R"}, 0, (x + 48) % 96, 40),
              test::pixel_of(test::place("b_out.exr"), {"R"}, 0, x, 40))
        << x;
  EXPECT_NE(test::pixel_of(test::place("a_out.exr"), {"R"}, 0, 0, 40),
            test::pixel_of(test::place("a.exr"), {"R"}, 0, 0, 40));
}

/// Largest difference of neighbours, along the way the texture runs: less is more blurred.
double contrast(const std::string& file, bool across) {
  double most = 0;
  for (int i = 30; i < 60; ++i)
    most = std::max(most, std::abs(static_cast<double>(
                              test::pixel_of(file, {"R"}, 0, across ? i : 48, across ? 48 : i)[0] -
                              test::pixel_of(file, {"R"}, 0, across ? i + 1 : 48, across ? 48 : i + 1)[0])));
  return most;
}

TEST(Geometry, pixels_that_are_twice_as_wide_as_high_are_blurred_over_twice_as_many_rows) {
  const auto run = [](float aspect, bool across, const char* ppd) {
    write_stripes(test::place("in.exr"), 0, aspect, false, across);
    std::vector<std::string> more = blurred;
    *(std::find(more.begin(), more.end(), "--ppd") + 1) = ppd;
    EXPECT_EQ(test::apply(test::place("in.exr"), test::place("out.exr"), more).exit_code, 0);
    return contrast(test::place("out.exr"), across);
  };
  // Down: the sigma of twice as many pixels per degree; across: no other.
  EXPECT_NEAR(run(2, false, "8") / run(1, false, "16"), 1, 0.1);
  EXPECT_NEAR(run(2, true, "8") / run(1, true, "8"), 1, 0.1);
  EXPECT_LT(run(2, false, "8"), 0.9 * run(1, false, "8"));
}

TEST(Geometry, facts_of_other_pixels_are_gone) {
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1}, [](Imf::Header& h) {
    h.insert("oiio:SHA-1", Imf::StringAttribute("F9F3FC8D1BD724631EECCBCB7A903F55A8E74AB5"));
    h.insert("oiio:AverageColor", Imf::StringAttribute("1,1,1"));
    h.insert("oiio:ConstantColor", Imf::StringAttribute("1,1,1"));
    h.insert("owner", Imf::StringAttribute("who made it"));
    h.setPreviewImage(Imf::PreviewImage(2, 2));
  });
  ASSERT_EQ(test::apply(test::place("in.exr"), test::place("out.exr"), {"--adaptation", "0.01"}).exit_code,
            0);
  const std::string out = bytes_of(test::place("out.exr"));
  for (const char* name : {"oiio:SHA-1", "oiio:AverageColor", "oiio:ConstantColor", "preview"})
    EXPECT_EQ(out.find(name), std::string::npos) << name;
  EXPECT_NE(out.find("who made it"), std::string::npos);
}

}  // namespace
}  // namespace scotopic

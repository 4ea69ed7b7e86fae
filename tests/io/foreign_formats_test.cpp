// TIFF, PNG, JPEG: what passes, what is refused.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "pipeline/apply_image.h"
#include "base/error.h"
#include "support/exr_files.h"

namespace scotopic {
namespace {

using test::file_bytes;
using test::run_operator;
using test::temporary;

/// A picture of all codes of its type, in the order of a fixed generator.
template <typename T>
std::vector<T> codes(int pixels, int channels) {
  std::vector<T> out(static_cast<std::size_t>(pixels) * static_cast<std::size_t>(channels));
  std::uint32_t state = 1;
  for (T& value : out) {
    state = state * 1664525u + 1013904223u;  // Numerical Recipes
    value = static_cast<T>(state >> 16);
  }
  return out;
}

template <typename T>
std::vector<T> write(const std::string& file, int channels, OIIO::TypeDesc type, int tile = 0,
                     int pages = 1) {
  const auto out = OIIO::ImageOutput::create(file);
  OIIO::ImageSpec spec(50, 40, channels, type);
  spec.tile_width = spec.tile_height = tile;
  spec.attribute("Artist", "a night owl");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const std::vector<T> pixels = codes<T>(50 * 40, channels);
  for (int page = 0; page < pages; ++page) {
    EXPECT_TRUE(out->open(file, spec, page ? OIIO::ImageOutput::AppendSubimage : OIIO::ImageOutput::Create));
    EXPECT_TRUE(out->write_image(type, pixels.data())) << out->geterror();
  }
  out->close();
  return pixels;
}

template <typename T>
std::vector<T> read(const std::string& file, int page = 0) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(file, &hints);
  if (!in || !in->seek_subimage(page, 0)) return {};
  const OIIO::ImageSpec spec = in->spec();
  std::vector<T> out(static_cast<std::size_t>(spec.image_pixels()) *
                     static_cast<std::size_t>(spec.nchannels));
  EXPECT_TRUE(in->read_image(page, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<T>::value, out.data()))
      << in->geterror();
  return out;
}

TEST(ForeignFormats, a_photopic_scene_comes_back_bit_for_bit) {
  for (const std::string extension : {".png", ".tif"}) {
    const std::string in = temporary("in" + extension), out = temporary("out" + extension);
    const auto eight = write<std::uint8_t>(in, 4, OIIO::TypeDesc::UINT8);
    run_operator(in, out, 10);
    EXPECT_EQ(read<std::uint8_t>(out), eight) << extension;
    const auto sixteen = write<std::uint16_t>(in, 3, OIIO::TypeDesc::UINT16);
    run_operator(in, out, 10);
    EXPECT_EQ(read<std::uint16_t>(out), sixteen) << extension;
  }
}

TEST(ForeignFormats, tiff_tiles_pages_and_floats_pass) {
  const std::string in = temporary("in.tif"), out = temporary("out.tif");
  const auto tiled = write<std::uint16_t>(in, 3, OIIO::TypeDesc::UINT16, 16);
  run_operator(in, out, 10);
  EXPECT_EQ(read<std::uint16_t>(out), tiled);
  EXPECT_EQ(OIIO::ImageInput::open(out)->spec().tile_width, 16);
  const auto pages = write<std::uint16_t>(in, 3, OIIO::TypeDesc::UINT16, 0, 3);
  run_operator(in, out, 10);
  for (int page = 0; page < 3; ++page) EXPECT_EQ(read<std::uint16_t>(out, page), pages) << page;
}

TEST(ForeignFormats, what_was_applied_can_be_read_from_the_file) {
  write<std::uint8_t>(temporary("in.png"), 3, OIIO::TypeDesc::UINT8);
  run_operator(temporary("in.png"), temporary("out.png"), 0.5);
  EXPECT_EQ(OIIO::ImageInput::open(temporary("out.png"))->spec().get_string_attribute("scotopic:adaptation"),
            "0.5");
  write<std::uint8_t>(temporary("in.tif"), 3, OIIO::TypeDesc::UINT8);
  run_operator(temporary("in.tif"), temporary("out.tif"), 0.5);
  const OIIO::ImageSpec spec = OIIO::ImageInput::open(temporary("out.tif"))->spec();
  EXPECT_NE(spec.get_string_attribute("ImageDescription").find("scotopic:adaptation=0.5"), std::string::npos);
  EXPECT_EQ(spec.get_string_attribute("Artist"), "a night owl");
}

TEST(ForeignFormats, a_picture_in_integers_is_display_encoded_and_becomes_linear_openexr) {
  write<std::uint8_t>(temporary("in.png"), 4, OIIO::TypeDesc::UINT8);
  const ImageLayout layout = run_operator(temporary("in.png"), temporary("out.exr"), 10);
  EXPECT_EQ(layout.light[0].space.name, "sRGB - Texture");
  EXPECT_EQ(layout.output_space.name, "Linear Rec.709 (sRGB)");
  const auto eight = read<std::uint8_t>(temporary("in.png"));
  const auto linear = read<float>(temporary("out.exr"));
  ASSERT_EQ(eight.size(), linear.size());
  double worst = 0;
  for (std::size_t i = 0; i < eight.size(); i += 4) {
    const double encoded = eight[i] / 255.0, alpha = eight[i + 3] / 255.0;
    const double value = encoded <= .04045 ? encoded / 12.92 : std::pow((encoded + .055) / 1.055, 2.4);
    worst = std::max(worst, std::abs(static_cast<double>(linear[i]) - value * alpha));
  }
  std::printf("worst error of linear, associated half: %.2g\n", worst);
  EXPECT_LE(worst, 0x1p-11);  // half's rounding below 1: 2^-12, and OCIO's join of sRGB's two pieces
}

TEST(ForeignFormats, a_file_cut_short_is_an_error_and_leaves_nothing) {
  for (const std::string name : {"in.png", "in.tif"}) {
    write<std::uint16_t>(temporary(name), 3, OIIO::TypeDesc::UINT16);
    const std::string whole = file_bytes(temporary(name));
    for (std::size_t size : {std::size_t{4}, std::size_t{20}, whole.size() / 3, whole.size() / 2}) {
      std::ofstream(temporary("cut"), std::ios::binary) << whole.substr(0, size);
      EXPECT_THROW(run_operator(temporary("cut"), temporary("out.png"), 1), Error) << name << " " << size;
      EXPECT_FALSE(std::filesystem::exists(temporary("out.png"))) << name << " " << size;
    }
  }
}

TEST(ForeignFormats, types_that_the_output_cannot_hold_are_refused) {
  write<std::uint8_t>(temporary("in.png"), 3, OIIO::TypeDesc::UINT8);
  ImageRequest request;
  request.type = PixelType::half;
  EXPECT_THROW(run_operator(temporary("in.png"), temporary("out.png"), 1, request), Error);
  request.type = PixelType::uint8;
  EXPECT_THROW(run_operator(temporary("in.png"), temporary("out.exr"), 1, request), Error);
}

TEST(ForeignFormats, jpeg_holds_the_colours_and_what_was_done) {
  test::TestPart part;
  part.channels = {
      {"A", PixelType::half}, {"B", PixelType::half}, {"G", PixelType::half}, {"R", PixelType::half}};
  part.data = {-3, 5, 61, 69};
  part.finite = true;
  test::write_exr(temporary("in.exr"), {part});
  ImageRequest request;
  request.jpeg_quality = 100;
  const ImageLayout layout = run_operator(temporary("in.exr"), temporary("out.jpg"), 0.5, request);
  ImageRequest png;
  png.type = PixelType::uint8;
  run_operator(temporary("in.exr"), temporary("out.png"), 0.5, png);
  EXPECT_EQ(layout.outputs.front().subimage.channels.size(), 3u);
  EXPECT_EQ(layout.output_space.name, "sRGB - Texture");
  const auto in = OIIO::ImageInput::open(temporary("out.jpg"));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().width, 64);
  EXPECT_EQ(in->spec().nchannels, 3);
  EXPECT_NE(in->spec().get_string_attribute("ImageDescription").find("scotopic:adaptation=0.5"),
            std::string::npos);
  EXPECT_EQ(in->spec().get_string_attribute("jpeg:subsampling"), "4:4:4");
}

TEST(ForeignFormats, jpeg_has_no_alpha_so_colour_is_what_alpha_leaves_of_it) {
  const std::vector<std::uint8_t> source = write<std::uint8_t>(temporary("in.png"), 4, OIIO::TypeDesc::UINT8);
  ImageRequest request;
  request.jpeg_quality = 100;
  const ImageLayout layout = run_operator(temporary("in.png"), temporary("out.jpg"), 10, request);
  ASSERT_EQ(layout.notes.size(), 1u);
  EXPECT_NE(layout.notes[0].find("1 other channels are not written"), std::string::npos) << layout.notes[0];
  const std::vector<std::uint8_t> got = read<std::uint8_t>(temporary("out.jpg"));
  ASSERT_EQ(got.size(), 50u * 40u * 3u);
  // IEC 61966-2-1: what is left is light, not code values.
  const auto light = [](std::uint8_t v) {
    return v <= 10 ? v / 255.0 / 12.92 : std::pow((v / 255.0 + 0.055) / 1.055, 2.4);
  };
  double sum = 0, wanted = 0;
  for (std::size_t i = 0; i < 50 * 40; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      sum += light(got[3 * i + c]);
      wanted += light(source[4 * i + c]) * (source[4 * i + 3] / 255.0);
    }
  EXPECT_NEAR(sum / wanted, 1.0, 0.01);
}

TEST(ForeignFormats, what_a_display_is_sent_is_whole_numbers_in_tiff) {
  test::TestPart part;
  part.channels = {{"B", PixelType::half}, {"G", PixelType::half}, {"R", PixelType::half}};
  part.finite = true;
  test::write_exr(temporary("in.exr"), {part});
  ImageRequest request;
  request.view = "sRGB - Display/Un-tone-mapped";
  run_operator(temporary("in.exr"), temporary("view.tif"), 10, request);
  ImageRequest space;
  space.output_colourspace = "sRGB - Texture";
  space.type = PixelType::uint16;
  run_operator(temporary("in.exr"), temporary("space.tif"), 10, space);
  const std::vector<std::uint16_t> view = read<std::uint16_t>(temporary("view.tif"));
  EXPECT_EQ(view.size(), 37u * 50u * 3u);
  EXPECT_EQ(view, read<std::uint16_t>(temporary("space.tif")));
  const auto in = OIIO::ImageInput::open(temporary("view.tif"));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::UINT16);
}

TEST(ForeignFormats, a_tiff_that_says_srgb_or_carries_exif_can_be_read) {
  // Once it could not: Exif tags went into a stream that OpenImageIO cannot read back.
  test::TestPart part;
  part.channels = {{"B", PixelType::half}, {"G", PixelType::half}, {"R", PixelType::half}};
  part.finite = true;
  test::write_exr(temporary("in.exr"), {part});
  ImageRequest request;
  request.type = PixelType::uint8;
  request.output_colourspace = "sRGB - Texture";
  run_operator(temporary("in.exr"), temporary("out.tif"), 10, request);
  EXPECT_EQ(read<std::uint8_t>(temporary("out.tif")).size(), 37u * 50u * 3u);
  {
    const auto camera = OIIO::ImageOutput::create(temporary("camera.jpg"));
    OIIO::ImageSpec spec(64, 32, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("FNumber", 2.8f);
    spec.attribute("Exif:FocalLengthIn35mmFilm", 35);
    ASSERT_TRUE(camera->open(temporary("camera.jpg"), spec));
    camera->write_image(OIIO::TypeDesc::UINT8, std::vector<std::uint8_t>(64 * 32 * 3, 100).data());
    camera->close();
  }
  run_operator(temporary("camera.jpg"), temporary("camera.tif"), 10);
  EXPECT_EQ(read<std::uint8_t>(temporary("camera.tif")).size(), 64u * 32u * 3u);
  const auto camera = OIIO::ImageInput::open(temporary("camera.tif"));
  ASSERT_TRUE(camera);
  EXPECT_NEAR(camera->spec().get_float_attribute("FNumber"), 2.8f, 1e-6f);
}

}  // namespace
}  // namespace scotopic

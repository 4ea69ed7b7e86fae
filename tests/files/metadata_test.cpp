// Metadata that spoke of other pixels or other colours is dropped or made anew in every format that is
// written.
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "files/made_files.h"
#include "pipeline/apply_image.h"
#include "support/file_bytes.h"

namespace scotopic {
namespace {

using test::bytes_of;

/// A texture as maketx makes it: tiles, levels, and hashes and averages of its pixels.
void write_texture(const std::string& file, float value) {
  const OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf picture(spec);
  const float colour[3] = {value, value / 2, value / 3};
  OIIO::ImageBufAlgo::fill(picture, colour);
  picture.set_write_format(OIIO::TypeDesc::HALF);
  OIIO::ImageSpec config;
  config.attribute("maketx:oiio_options", 1);
  config.attribute("maketx:constant_color_detect", 1);
  config.attribute("maketx:compute_average", 1);
  ASSERT_TRUE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, picture, file, config))
      << OIIO::geterror();
}

std::vector<float> through_cache(OIIO::ImageCache& cache, const std::string& file) {
  std::vector<float> out(3);
  EXPECT_TRUE(
      cache.get_pixels(OIIO::ustring(file), 0, 0, 20, 21, 20, 21, 0, 1, OIIO::TypeDesc::FLOAT, out.data()))
      << cache.geterror();
  return out;
}

std::vector<float> from_file(const std::string& file) {
  std::vector<float> out(64 * 64 * 3);
  const auto in = OIIO::ImageInput::open(file);
  if (!in || !in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, out.data())) return {};
  const std::ptrdiff_t at = (20 * 64 + 20) * 3;
  return {out.begin() + at, out.begin() + at + 3};
}

TEST(Metadata, a_texture_cache_serves_the_night_not_the_day) {
  for (const char* extension : {"exr", "tif"}) {
    const std::string day = test::place(std::string("day.") + extension);
    const std::string night = test::place(std::string("night.") + extension);
    write_texture(day, 0.5f);
    ASSERT_EQ(test::apply(day, night, {"--adaptation", "0.01"}).exit_code, 0);
    auto cache = OIIO::ImageCache::create(false);
    const std::vector<float> first = through_cache(*cache, day), second = through_cache(*cache, night);
    EXPECT_EQ(second, from_file(night)) << extension;
    EXPECT_NE(second, first) << extension;
    OIIO::ImageCache::destroy(cache);
    const std::string bytes = bytes_of(night);
    EXPECT_NE(bytes_of(day).find("SHA-1"), std::string::npos) << extension;
    for (const char* stale : {"SHA-1", "AverageColor", "ConstantColor"})
      EXPECT_EQ(bytes.find(stale), std::string::npos) << extension << " " << stale;
  }
}

/// A file, and what its tags are.
struct Tagged {
  std::string file;
  std::string what;
};

std::vector<Tagged> tagged_files() {
  const auto chunk = [](const char* name, std::uint32_t value) {
    return test::Chunk{name, test::big_endian(value)};
  };
  const test::Chunk chrm = {"cHRM", test::big_endian(31270) + test::big_endian(32900) +
                                        test::big_endian(64000) + test::big_endian(33000) +
                                        test::big_endian(21000) + test::big_endian(71000) +
                                        test::big_endian(15000) + test::big_endian(6000)};
  const std::vector<std::pair<std::string, std::vector<test::Chunk>>> pngs = {
      {"no chunk", {}},
      {"gAMA 1", {chunk("gAMA", 100000)}},
      {"gAMA and cHRM", {chunk("gAMA", 55556), chrm}},
      {"cICP linear BT.2020", {{"cICP", std::string("\x9\x8\0\x1", 4)}}},
      {"sRGB", {{"sRGB", std::string(1, '\0')}}},
      {"iCCP", {test::png_profile(test::adobe_profile())}}};
  std::vector<Tagged> out;
  for (const auto& [what, chunks] : pngs) {
    out.push_back({test::place("in" + std::to_string(out.size()) + ".png"), "PNG with " + what});
    test::write_bytes(out.back().file, test::flat_png({30000, 20000, 25000}, chunks));
  }
  for (const bool sixteen : {false, true}) {
    out.push_back({test::place("in" + std::to_string(out.size()) + ".tif"), "TIFF with a profile"});
    test::write_flat_oiio(out.back().file, {0.4f, 0.3f, 0.35f}, sixteen, test::adobe_profile());
  }
  out.push_back({test::place("in.jpg"), "JPEG with a profile"});
  test::write_flat_oiio(out.back().file, {0.4f, 0.3f, 0.35f}, false, test::adobe_profile());
  const std::vector<std::pair<std::string, std::function<void(Imf::Header&)>>> headers = {
      {"no attribute", [](Imf::Header&) {}},
      {"chromaticities",
       [](Imf::Header& h) {
         Imf::addChromaticities(h, {{0.64f, 0.33f}, {0.21f, 0.71f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}});
       }},
      {"an ACES container", [](Imf::Header& h) { h.insert("acesImageContainerFlag", Imf::IntAttribute(1)); }},
      {"an identifier",
       [](Imf::Header& h) { h.insert("colorInteropID", Imf::StringAttribute("lin_ap1_scene")); }},
      {"an encoded identifier",
       [](Imf::Header& h) { h.insert("colorInteropID", Imf::StringAttribute("srgb_rec709_scene")); }}};
  for (const auto& [what, header] : headers) {
    out.push_back({test::place("in" + std::to_string(out.size()) + ".exr"), "OpenEXR with " + what});
    test::write_flat_exr(out.back().file, {0.4, 0.3, 0.35}, header);
  }
  return out;
}

/// Writes a file anew as daylight has it, in a space of the program's config ("": its own).
void rewrite(const std::string& in, const std::string& out, const std::string& space, PixelType type) {
  static const ColourConfig config = ColourConfig::own();
  ImageRequest request;
  if (!space.empty()) request.output_colourspace = space;
  request.type = type;
  request.night = NightDisplayMode::never;
  OutputFile file(out);
  const std::unique_ptr<PixelSource> source = open_source(in, Limits());
  const ImageLayout layout = plan_layout(*source, out, config, request);
  apply_image(*source, layout, config, ImageStages(), file);
}

/// Light of a file in linear BT.709.
std::vector<float> light_written(const std::string& file) {
  rewrite(file, test::place("light.exr"), "Linear Rec.709 (sRGB)", PixelType::float32);
  return test::pixel_of(test::place("light.exr"), {"R", "G", "B"});
}

/// What is written says what it is, whatever the file it comes from said: it reads back as the same light.
TEST(Metadata, colours_of_what_is_written_are_those_its_tags_state) {
  double worst = 0;
  std::string worst_at;
  int pairs = 0;
  for (const Tagged& in : tagged_files()) {
    const std::vector<float> wanted = light_written(in.file);
    for (const std::string space : {"", "Linear Rec.709 (sRGB)", "ACEScg", "ACES2065-1", "sRGB - Texture"})
      for (const std::string name : {"out.exr", "out.tif", "out.png"}) {
        if (space == "sRGB - Texture" && name == "out.exr") continue;  // said: below
        rewrite(in.file, test::place(name), space,
                name == "out.png" ? PixelType::uint16 : PixelType::float32);
        const std::string what = in.what + " to " + name + " in " + (space.empty() ? "its own space" : space);
        const std::vector<float> got = light_written(test::place(name));
        ++pairs;
        for (std::size_t c = 0; c < 3; ++c) {
          const double off = std::abs(static_cast<double>(got[c]) - static_cast<double>(wanted[c]));
          if (off > worst) worst_at = what;
          worst = std::max(worst, off);
          // A gamma in ICC.1:2001 is a whole number of 1/256.
          EXPECT_LT(off, 1e-3) << what << ", component " << c;
        }
      }
  }
  std::printf("%d pairs of tags: worst %.2g (%s)\n", pairs, worst, worst_at.c_str());
}

TEST(Metadata, a_space_that_no_tag_can_state_is_said) {
  test::write_flat_exr(test::place("in.exr"), {0.4, 0.3, 0.35});
  const test::Run run =
      test::apply(test::place("in.exr"), test::place("out.exr"), {"--output-colorspace", "sRGB - Texture"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("which nothing in the file says"), std::string::npos) << run.err;
}

TEST(Metadata, a_profile_stays_where_the_space_stays_and_goes_with_it) {
  const std::string profile = test::adobe_profile();
  test::write_flat_oiio(test::place("in.tif"), {0.4f, 0.3f, 0.35f}, true, profile);
  ASSERT_EQ(test::apply(test::place("in.tif"), test::place("same.tif"), {"--display", "none"}).exit_code, 0);
  EXPECT_NE(bytes_of(test::place("same.tif")).find(profile.substr(40)), std::string::npos);
  ASSERT_EQ(test::apply(test::place("in.tif"), test::place("other.tif"),
                        {"--display", "none", "--output-colorspace", "sRGB - Texture"})
                .exit_code,
            0);
  const std::string other = bytes_of(test::place("other.tif"));
  ASSERT_FALSE(other.empty());
  EXPECT_EQ(other.find("acsp"), std::string::npos);  // the mark of any profile
  EXPECT_NE(profile.find("acsp"), std::string::npos);
}

}  // namespace
}  // namespace scotopic

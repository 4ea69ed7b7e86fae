// Pixels that are no light: told of once, by every verb that writes, whatever is done to the others.
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace scotopic {
namespace {

constexpr int width = 600, height = 40;  // more than a piece of a row
struct Place {
  int x, y;
};
constexpr Place bad[] = {{513, 3}, {4, 17}};

class NonFiniteReport : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::work_folder();
    Imf::Array2D<Imf::Rgba> pixels(height, width);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        pixels[y][x] = Imf::Rgba(0.1f, 0.05f + 0.0003f * static_cast<float>(x), 0.2f);
    pixels[bad[0].y][bad[0].x].b = std::numeric_limits<float>::quiet_NaN();
    pixels[bad[1].y][bad[1].x].r = -std::numeric_limits<float>::infinity();
    Imf::RgbaOutputFile file(path("in.exr").c_str(), width, height, Imf::WRITE_RGB);
    file.setFrameBuffer(&pixels[0][0], 1, width);
    file.writePixels(height);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  test::Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin() + 1, {path("in.exr"), "-o", path("out.exr")});
    return test::run_program(arguments);
  }
  /// Pixels of the output with such a component.
  int bad_pixels() const {
    Imf::RgbaInputFile file(path("out.exr").c_str());
    Imf::Array2D<Imf::Rgba> pixels(height, width);
    file.setFrameBuffer(&pixels[0][0], 1, width);
    file.readPixels(0, height - 1);
    return static_cast<int>(std::count_if(
        &pixels[0][0], &pixels[0][0] + width * height,
        [](const Imf::Rgba& p) { return !(p.r.isFinite() && p.g.isFinite() && p.b.isFinite()); }));
  }
  std::string folder_;
};

int times(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++count;
  return count;
}

struct Case {
  const char* description;
  std::vector<std::string> options;
};
const Case cases[] = {
    {"every effect", {"--adaptation", "0.05"}},
    {"the operator in double", {"--adaptation", "0.05", "--precision", "double"}},
    {"a filter after it", {"--adaptation", "0.05", "--acuity", "--ppd", "60"}},
    {"nothing called for: the file's bytes go through", {"--adaptation", "50"}},
    {"nothing done", {"--adaptation", "0.05", "--effects", "none"}},
    {"nothing called for, but another space", {"--adaptation", "50", "--output-colorspace", "ACES2065-1"}},
    {"metered", {"--white-luminance", "1"}},
};

TEST_F(NonFiniteReport, is_one_line_with_number_and_first_place_whatever_is_called_for) {
  for (const Case& c : cases)
    for (const char* policy : {"keep", "clean"}) {
      SCOPED_TRACE(std::string(c.description) + ", " + policy);
      std::vector<std::string> arguments = {"apply", "--nonfinite", policy};
      arguments.insert(arguments.end(), c.options.begin(), c.options.end());
      const test::Outcome said = run(arguments);
      ASSERT_EQ(said.exit_code, 0) << said.err;
      EXPECT_EQ(times(said.err, "not finite"), 1) << said.err;
      EXPECT_NE(said.err.find("in.exr: 2 pixels are not finite, the first at (513, 3); "), said.err.npos)
          << said.err;
      arguments.push_back("--json");
      EXPECT_EQ(nlohmann::json::parse(run(arguments).out).at("nonFinite"), 2);
      EXPECT_EQ(bad_pixels(), std::string(policy) == "keep" ? 2 : 0);
    }
}

TEST_F(NonFiniteReport, an_image_of_light_has_none) {
  test::write_picture(path("in.exr"), 64, 48);
  for (const char* adaptation : {"0.05", "50"}) {
    const test::Outcome said = run({"apply", "--adaptation", adaptation, "--json"});
    EXPECT_EQ(nlohmann::json::parse(said.out).at("nonFinite"), 0);
    EXPECT_EQ(times(said.err, "not finite"), 0) << said.err;
  }
}

TEST_F(NonFiniteReport, error_refuses_the_file_and_writes_nothing) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.description);
    std::vector<std::string> arguments = {"apply", "--nonfinite", "error", "-q"};
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const test::Outcome said = run(arguments);
    EXPECT_EQ(said.exit_code, 3);
    EXPECT_EQ(times(said.err, "\n"), 1) << said.err;
    EXPECT_NE(said.err.find("2 pixels are not finite, the first at (513, 3)"), said.err.npos) << said.err;
    EXPECT_FALSE(std::filesystem::exists(path("out.exr")));
  }
}

TEST_F(NonFiniteReport, lmsr_tells_of_them_too) {
  const test::Outcome said = run({"lmsr"});
  ASSERT_EQ(said.exit_code, 0) << said.err;
  EXPECT_NE(said.err.find("2 pixels are not finite, the first at (513, 3)"), said.err.npos) << said.err;
  EXPECT_EQ(nlohmann::json::parse(run({"lmsr", "--json"}).out).at("nonFinite"), 2);
}

TEST_F(NonFiniteReport, explain_leaves_them_out_of_its_numbers_and_says_so) {
  const test::Outcome said = test::run_program({"explain", path("in.exr"), "--adaptation", "0.05"});
  ASSERT_EQ(said.exit_code, 0) << said.err;
  EXPECT_EQ(
      times(said.err, "in.exr: 2 pixels are not finite, the first at (513, 3); in none of these numbers"), 1)
      << said.err;
}

TEST_F(NonFiniteReport, spectra_that_are_not_finite_are_told_of_and_spoil_no_other_pixel) {
  Imf::Header header(width, height);
  const char* bands[] = {"S0.450,0nm", "S0.550,0nm", "S0.650,0nm"};
  std::vector<float> light(width * height, 0.2f), hole = light;
  hole[bad[0].y * width + bad[0].x] = std::numeric_limits<float>::quiet_NaN();
  hole[bad[1].y * width + bad[1].x] = std::numeric_limits<float>::infinity();
  Imf::FrameBuffer frame;
  for (const char* band : bands) {
    header.channels().insert(band, Imf::Channel(Imf::FLOAT));
    frame.insert(
        band, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(band == bands[1] ? hole.data() : light.data()),
                         sizeof(float), sizeof(float) * width));
  }
  {
    Imf::OutputFile file(path("in.exr").c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  for (const char* verb : {"lmsr", "apply"})
    for (const char* threads : {"1", "3"}) {
      SCOPED_TRACE(std::string(verb) + " on threads: " + threads);
      std::vector<std::string> arguments = {verb, "--threads", threads};
      if (verb == std::string("apply")) arguments.insert(arguments.end(), {"--adaptation", "0.05"});
      const test::Outcome said = run(arguments);
      ASSERT_EQ(said.exit_code, 0) << said.err;
      EXPECT_NE(said.err.find("2 pixels are not finite, the first at (513, 3)"), said.err.npos) << said.err;
      if (verb == std::string("apply")) {
        EXPECT_EQ(bad_pixels(), 2);
      }
    }
}

TEST_F(NonFiniteReport, colour_beside_an_alpha_that_is_no_number_stays_colour) {
  // TIFF holds alpha beside colour, OpenEXR multiplied into it.
  for (const float alpha :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    OIIO::ImageSpec spec(4, 1, 4, OIIO::TypeDesc::FLOAT);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    std::vector<float> pixels(16, 0.5f);
    pixels[7] = alpha;
    const auto tiff = OIIO::ImageOutput::create(path("in.tif"));
    ASSERT_TRUE(tiff && tiff->open(path("in.tif"), spec) &&
                tiff->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    tiff->close();
    const test::Outcome said = test::run_program(
        {"apply", path("in.tif"), "-o", path("out.exr"), "--adaptation", "0.05", "-d", "float"});
    ASSERT_EQ(said.exit_code, 0) << said.err;
    const auto exr = OIIO::ImageInput::open(path("out.exr"));
    std::vector<float> seen(16);
    ASSERT_TRUE(exr && exr->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, seen.data()));
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(std::isfinite(seen[i]), i != 7) << i;
  }
}

}  // namespace
}  // namespace scotopic

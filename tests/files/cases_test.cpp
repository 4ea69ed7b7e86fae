// Troubles of users with other programs, each with the value that its files and formulas give.
#include <OpenEXR/ImfEnvmap.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/run_program.h"
#include "files/made_files.h"

namespace scotopic {
namespace {

using test::says;

/// A config whose default rule and bytes are encoded, and whose role for floats says that they are linear.
void write_encoded_config(const std::string& file, const std::string& more_roles) {
  test::write_bytes(
      file,
      "ocio_profile_version: 2\n"
      "roles: {default: enc, scene_linear: lin, aces_interchange: lin" +
          more_roles +
          "}\n"
          "file_rules:\n  - !<Rule> {name: Default, colorspace: enc}\n"
          "displays:\n  d:\n    - !<View> {name: v, colorspace: enc}\n"
          "colorspaces:\n  - !<ColorSpace> {name: lin}\n"
          "  - !<ColorSpace> {name: enc, to_scene_reference: !<ExponentTransform> {value: [2.2, 2.2, "
          "2.2, 1]}}\n");
}

TEST(Cases, the_role_default_float_tells_of_floats) {
  test::write_flat_exr(test::place("in.exr"), {0.18, 0.18, 0.18});
  const auto adaptation = [](const std::string& roles) {
    write_encoded_config(test::place("c.ocio"), roles);
    const test::Outcome run = test::run_program({"explain", test::place("in.exr"), "--white-luminance", "1",
                                                 "--config", test::place("c.ocio"), "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const std::size_t at = run.out.find("\"adaptation\":");
    return at == std::string::npos ? 0.0 : std::atof(run.out.c_str() + at + 13);
  };
  EXPECT_NEAR(adaptation(", default_float: lin"), 0.18, 1e-4);
  EXPECT_NEAR(adaptation(""), std::pow(0.18, 2.2), 1e-4);  // 0.0230: the default rule
}

TEST(Cases, fluorescence_is_said_to_be_left_out) {
  std::vector<test::FlatChannel> bands;
  for (const char* name : {"T.400,0nm", "T.500,0nm", "T.600,0nm", "T.400,0nm.500,0nm", "T.400,0nm.600,0nm"})
    bands.push_back({name, 0.5f});
  test::write_flat_exr(
      test::place("in.exr"),
      {{"", bands, [](Imf::Header& h) { h.insert("spectralLayoutVersion", Imf::StringAttribute("1.0")); }}});
  const test::Run run = test::apply(test::place("in.exr"), test::place("out.exr"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(says(run.err, "fluorescence is left out: T.400,0nm.500,0nm, T.400,0nm.600,0nm")) << run.err;
  // A grey reflectance of a half under D65, without what fluoresces.
  const std::vector<float> p = test::pixel_of(test::place("out.exr"), {"R", "G", "B"});
  for (const float v : p) EXPECT_NEAR(v, 0.5f, 0.1f);
}

constexpr int picture_width = 128, picture_height = 64;

/// Rows of 0.05, 0.065, 0.05, 0.035 and so on, or a row of noise by columns, turned by `roll` of them.
void write_picture(const std::string& file, float aspect, int roll, const char* panorama) {
  Imf::Header header(picture_width, picture_height, aspect);
  if (panorama && panorama == std::string("envmap"))
    Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  else if (panorama)
    header.insert(
        panorama,
        Imf::StringAttribute(panorama == std::string("textureformat") ? "LatLong Environment" : "latlong"));
  std::vector<Imf::Rgba> pixels;
  for (int y = 0; y < picture_height; ++y)
    for (int x = 0; x < picture_width; ++x) {
      const int at = (x + roll) % picture_width;
      const float v = panorama ? 0.05f + 0.015f * static_cast<float>((at * 37 + y * 11) % 19 - 9) / 9
                               : 0.05f + 0.015f * static_cast<float>(y % 4 == 1   ? 1
                                                                     : y % 4 == 3 ? -1
                                                                                  : 0);
      pixels.emplace_back(v, v, v);
    }
  Imf::RgbaOutputFile out(file.c_str(), header, Imf::WRITE_RGB);
  out.setFrameBuffer(pixels.data(), 1, picture_width);
  out.writePixels(picture_height);
}

std::vector<std::string> detail(const char* what, const char* resolution, const char* value) {
  return {what == std::string("local") ? "--acuity" : "--detail",
          what == std::string("local") ? "" : what,
          resolution,
          value,
          "--effects",
          "detail",
          "--white-luminance",
          "0.05",
          "--adaptation",
          "0.01",
          "-d",
          "float"};
}

test::Run blur(const std::string& in, const std::string& out, const char* what, const char* resolution,
               const char* value) {
  std::vector<std::string> more = detail(what, resolution, value);
  std::erase(more, "");
  const test::Run run = test::apply(in, out, more);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run;
}

/// Steepest step between rows at mid-width.
double steepest(const std::string& file) {
  double most = 0;
  for (int y = 1; y < picture_height; ++y)
    most = std::max(most, std::abs(static_cast<double>(test::pixel_of(file, {"R"}, 0, 64, y)[0]) -
                                   static_cast<double>(test::pixel_of(file, {"R"}, 0, 64, y - 1)[0])));
  return most;
}

TEST(Cases, rows_of_wide_pixels_are_finer_than_columns) {
  // 128 columns over 2 degrees: 64 pixels a degree across; rows of pixels twice as wide as high: 128.
  write_picture(test::place("asp1.exr"), 1, 0, nullptr);
  write_picture(test::place("asp2.exr"), 2, 0, nullptr);
  blur(test::place("asp1.exr"), test::place("o1.exr"), "bilateral", "--fov", "2");
  blur(test::place("asp2.exr"), test::place("o2.exr"), "bilateral", "--fov", "2");
  blur(test::place("asp1.exr"), test::place("o3.exr"), "bilateral", "--ppd", "128");
  // Sigma of twice as many rows halves the steepest slope that is left, as twice the resolution does.
  EXPECT_NEAR(steepest(test::place("o2.exr")) / steepest(test::place("o1.exr")), 0.5, 0.03);
  EXPECT_NEAR(steepest(test::place("o2.exr")) / steepest(test::place("o3.exr")), 1.0, 0.03);
}

TEST(Cases, a_panorama_has_no_seam_by_whatever_name_it_is_one) {
  for (const char* sign : {"envmap", "openexr:envmap", "textureformat"})
    for (const char* what : {"bilateral", "contrast"}) {
      write_picture(test::place("a.exr"), 1, 0, sign);
      write_picture(test::place("b.exr"), 1, picture_width / 2, sign);
      blur(test::place("a.exr"), test::place("ao.exr"), what, "--ppd", "60");
      blur(test::place("b.exr"), test::place("bo.exr"), what, "--ppd", "60");
      for (int x = 0; x < picture_width; ++x)
        ASSERT_EQ(
            test::pixel_of(test::place("ao.exr"), {"R"}, 0, (x + picture_width / 2) % picture_width, 40),
            test::pixel_of(test::place("bo.exr"), {"R"}, 0, x, 40))
            << sign << " " << what << " column " << x;
      EXPECT_NE(test::pixel_of(test::place("ao.exr"), {"R"}, 0, 0, 40),
                test::pixel_of(test::place("a.exr"), {"R"}, 0, 0, 40));
    }
}

/// A TIFF of 4 x 4 grey pixels of 51 (8 bits) or 0x3333 (16), little-endian, with more entries (tag, short
/// value).
std::string grey_tiff(std::uint32_t bits, std::uint32_t photometric,
                      const std::vector<std::pair<std::uint32_t, std::uint32_t>>& more) {
  const auto little = [](std::uint32_t value, int bytes) {
    const std::string big = test::big_endian(value, bytes);
    return std::string(big.rbegin(), big.rend());
  };
  std::map<std::uint32_t, std::uint32_t> entries = {
      {256, 4}, {257, 4}, {258, bits}, {259, 1}, {262, photometric}, {277, 1}, {278, 4}, {279, 2 * bits}};
  entries.insert(more.begin(), more.end());
  entries[273] = 8 + 2 + 12 * (static_cast<std::uint32_t>(entries.size()) + 1) + 4;
  std::string out =
      std::string("II*\0", 4) + little(8, 4) + little(static_cast<std::uint32_t>(entries.size()), 2);
  for (const auto& [tag, value] : entries)
    out += little(tag, 2) + little(4, 2) + little(1, 4) + little(value, 4);
  return out + little(0, 4) + std::string(2 * bits, '\x33');
}

TEST(Cases, raw_files_of_cameras_are_no_pictures_yet) {
  const std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> raw = {{{50706, 0x00000401}},
                                                                                 {{254, 1}, {330, 8}}};
  for (const auto& more : raw) {
    test::write_bytes(test::place("in.tif"), grey_tiff(8, 1, more));
    const test::Run run = test::apply(test::place("in.tif"), test::place("out.exr"));
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_TRUE(says(run.err, "is a camera's raw file")) << run.err;
  }
  test::write_bytes(test::place("in.tif"), grey_tiff(8, 32803, {}));
  EXPECT_EQ(test::apply(test::place("in.tif"), test::place("out.exr")).exit_code, 3);
  test::write_bytes(test::place("in.tif"), grey_tiff(8, 1, {}));
  EXPECT_EQ(test::apply(test::place("in.tif"), test::place("out.exr")).exit_code, 0);
}

TEST(Cases, grey_whose_zero_is_white_is_turned_round_or_refused) {
  const auto grey = [](std::uint32_t bits) {
    test::write_bytes(test::place("in.tif"), grey_tiff(bits, 0, {}));
    return test::apply(test::place("in.tif"), test::place("out.exr"), {"-d", "float"});
  };
  ASSERT_EQ(grey(8).exit_code, 0);
  // A code of .2 is .8 of white.
  EXPECT_NEAR(test::pixel_of(test::place("out.exr"), {"G"})[0], std::pow((0.8 + 0.055) / 1.055, 2.4), 1e-4);
  EXPECT_EQ(grey(16).exit_code, 3);
}

}  // namespace
}  // namespace scotopic

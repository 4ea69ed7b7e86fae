// TIFF: what its samples and tags can say, and what is made of each.
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files/brothers/table.h"

namespace scotopic {
namespace {

using test::as_codes;
using test::Expected;
using test::in_srgb;
using test::Rgb;
using test::TiffField;
using test::TiffSamples;

const TiffSamples bytes{{128, 64, 200}};
// P3's primaries, white D65; (0.6, 0.3, 0.1) in linear BT.709 by the two matrices.
const std::vector<double> p3 = {0.68, 0.32, 0.265, 0.69, 0.15, 0.06};
const Rgb p3_bytes = {0.25288, 0.044347, 0.62607}, p3_floats = {0.66748, 0.28738, 0.074454};

std::vector<double> table(std::size_t size, double exponent) {
  std::vector<double> out;
  for (std::size_t i = 0; i < size; ++i)
    out.push_back(
        std::round(65535 * std::pow(static_cast<double>(i) / static_cast<double>(size - 1), exponent)));
  return out;
}

std::vector<double> thrice(const std::vector<double>& one) {
  std::vector<double> out;
  for (int i = 0; i < 3; ++i) out.insert(out.end(), one.begin(), one.end());
  return out;
}

Rgb powers(double exponent) {
  return {std::pow(as_codes[0], exponent), std::pow(as_codes[1], exponent), std::pow(as_codes[2], exponent)};
}

const std::vector<double> d65 = {0.3127, 0.3290};
const TiffSamples floats{{0.6, 0.3, 0.1}, 32, 3};

TEST(Brothers, tags_of_tiff) {
  const auto expect = [](const TiffSamples& samples, const std::vector<TiffField>& fields,
                         const Expected& row) {
    test::write_bytes(test::place("in.tif"), test::flat_tiff(samples, fields));
    test::expect_row(test::place("in.tif"), row);
  };
  expect(bytes, {}, {"plain", in_srgb});
  expect(bytes, {{301, 3, table(256, 1)}}, {"TransferFunction, linear", as_codes, 1e-4, "TransferFunction"});
  expect(bytes, {{301, 3, thrice(table(256, 1.8))}}, {"TransferFunction, three of 1.8", powers(1.8)});
  expect(bytes, {{301, 3, table(256, 1)}, {318, 5, d65}, {319, 5, p3}},
         {"TransferFunction and primaries",
          {0.55842, 0.24042, 0.83180},
          2e-4,
          "TransferFunction and chromaticities"});
  expect(TiffSamples{{32896, 16448, 51400}, 16}, {{301, 3, table(65536, 1.8)}},
         {"TransferFunction of 16 bits", powers(1.8)});
  expect(bytes, {{301, 3, table(16, 1)}},
         {"TransferFunction of another size", in_srgb, 1e-4, "is left alone"});
  expect(bytes, {{301, 3, std::vector<double>(256)}}, {"all zero", {}, 0, "", "is no curve that rises"});
  expect(floats, {{301, 3, table(256, 1.8)}}, {"TransferFunction of floats", {0.6, 0.3, 0.1}});
  expect(bytes, {{318, 5, d65}, {319, 5, p3}}, {"primaries", p3_bytes});
  expect(bytes, {{318, 11, d65}, {319, 11, p3}}, {"primaries as floats", p3_bytes});
  expect(bytes, {{318, 12, d65}, {319, 12, p3}}, {"primaries as doubles", p3_bytes});
  expect(bytes, {{319, 5, p3}}, {"primaries without a white", p3_bytes, 1e-4, "D65 is assumed"});
  expect(floats, {{318, 5, d65}, {319, 5, p3}}, {"primaries of floats", p3_floats});
  expect({{128, 64, 200, 255}}, {}, {"a fourth channel", in_srgb, 1e-4, "taken for alpha"});
  expect({{128, 64, 200, 128}}, {{338, 3, {0}}}, {"a channel that is no alpha", in_srgb});
  expect({{9, 9, 9}, 24, 3}, {}, {"floats of 24 bits", {}, 0, "", "holds floats of 24 bits"});
  expect({{9, 9, 9}, 32, 6}, {}, {"complex", {}, 0, "", "complex"});
  expect({{9, 9, 9}, 32, 1}, {}, {"integers of 32 bits", {}, 0, "", "pixels of type uint"});
  expect({{9, 9, 9}, 64, 3}, {}, {"doubles", {}, 0, "", "pixels of type double"});
  expect({{1, 2, 3}, 8, 1, 8}, {}, {"Lab", {}, 0, "", "CIE Lab"});
  expect({{1, 2, 3, 4}, 8, 1, 5}, {}, {"CMYK", {}, 0, "", "CMYK"});
  expect({{51}, 8, 1, 0}, {},
         {"0 is white", {test::srgb_light(204), test::srgb_light(204), test::srgb_light(204)}});
  expect({{51}, 16, 1, 0}, {}, {"0 is white, 16 bits", {}, 0, "", "whose 0 is white"});
}

TEST(Brothers, a_transfer_function_comes_back_in_what_is_written) {
  test::write_bytes(test::place("in.tif"), test::flat_tiff(bytes, {{301, 3, table(256, 1.8)}}));
  ASSERT_EQ(test::apply(test::place("in.tif"), test::place("out.tif"), {"--display", "none"}).exit_code, 0);
  test::expect_row(test::place("out.tif"), {"read back", powers(1.8), 0.003});
}

TEST(Brothers, pixels_that_are_no_squares_stay_so) {
  const auto aspect = [](const std::string& file) {
    const test::Run run = test::apply(file, test::place("out.exr"));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return Imf::MultiPartInputFile(test::place("out.exr").c_str()).header(0).pixelAspectRatio();
  };
  // 100 to a length across, 200 down: each is twice as wide as high.
  test::write_bytes(test::place("in.tif"), test::flat_tiff(bytes, {{282, 5, {100}}, {283, 5, {200}}}));
  EXPECT_EQ(aspect(test::place("in.tif")), 2);
  test::write_bytes(test::place("in.tif"),
                    test::flat_tiff(bytes, {{282, 5, {100}}, {283, 5, {200}}, {274, 3, {6}}}));
  EXPECT_EQ(aspect(test::place("in.tif")), 0.5f);
  test::write_bytes(
      test::place("in.png"),
      test::flat_png({1, 2, 3}, {{"pHYs", test::big_endian(100) + test::big_endian(200) + '\0'}}));
  EXPECT_EQ(aspect(test::place("in.png")), 2);
  test::write_bytes(
      test::place("in.hdr"),
      "#?RADIANCE\nPIXASPECT=0.5\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n" + std::string({64, 64, 64, '\x80'}));
  EXPECT_EQ(aspect(test::place("in.hdr")), 2);
  // Through every format that is written, and back.
  for (const char* out : {"o.tif", "o.png", "o.jpg"}) {
    ASSERT_EQ(test::apply(test::place("in.hdr"), test::place(out)).exit_code, 0) << out;
    EXPECT_EQ(aspect(test::place(out)), 2) << out;
  }
}

TEST(Brothers, pages_that_are_not_written_are_told) {
  // The second directory is the first: two pages of the same pixels.
  std::string two = test::flat_tiff(bytes, {});
  const std::string again = test::flat_tiff(bytes, {});
  const std::size_t directory = 8 + 48, next = directory + 2 + 12 * 10;
  const auto at = static_cast<std::uint32_t>(two.size());
  for (std::size_t i = 0; i < 4; ++i) two[next + i] = static_cast<char>(at >> (8 * i) & 0xffu);
  two += test::tiff_directory({{256, 3, {4}},
                               {257, 3, {4}},
                               {258, 3, {8, 8, 8}},
                               {259, 3, {1}},
                               {262, 3, {2}},
                               {273, 4, {8}},
                               {277, 3, {3}},
                               {278, 3, {4}},
                               {279, 4, {48}}},
                              at);
  test::write_bytes(test::place("in.tif"), two);
  for (const char* out : {"out.exr", "out.png"}) {
    const test::Run run = test::apply(test::place("in.tif"), test::place(out));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("1 more pictures"), std::string::npos) << out << run.err;
  }
}

}  // namespace
}  // namespace scotopic

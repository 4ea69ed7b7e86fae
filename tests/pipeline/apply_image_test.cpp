#include "pipeline/apply_image.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "support/exr_files.h"
#include "io/exr/exr_source.h"
#include "receptors/receptor_space.h"

namespace scotopic {
namespace {

using test::file_bytes;
using test::read_bits;
using test::run_operator;
using test::temporary;
using test::TestPart;
using test::write_exr;

const std::vector<Channel> rgba_half = {
    {"A", PixelType::half}, {"B", PixelType::half}, {"G", PixelType::half}, {"R", PixelType::half}};
const std::vector<Channel> mixed_types = {{"A", PixelType::float32}, {"B", PixelType::half},
                                          {"G", PixelType::float32}, {"R", PixelType::half},
                                          {"Z", PixelType::float32}, {"id", PixelType::uint32}};

TestPart part_of(const std::string& name, const std::vector<Channel>& channels) {
  TestPart part;
  part.name = name;
  part.channels = channels;
  return part;
}

/// Layouts that files come in: windows, types, chunks, tiles, resolutions, orders, parts.
std::vector<std::pair<std::string, std::vector<TestPart>>> layouts() {
  std::vector<std::pair<std::string, std::vector<TestPart>>> out;
  out.push_back({"scanlines", {part_of("", rgba_half)}});
  out.push_back({"mixed", {part_of("", mixed_types)}});
  TestPart window = part_of("", mixed_types);
  window.data = {-5, -7, 30, 91};
  window.display = {0, 0, 20, 20};
  window.compression = Imf::PIZ_COMPRESSION;
  out.push_back({"window", {window}});
  TestPart down = window;
  down.order = Imf::DECREASING_Y;
  out.push_back({"downwards", {down}});
  TestPart tiles = window;
  tiles.tiles = Imf::TileDescription(16, 8);
  out.push_back({"tiles", {tiles}});
  TestPart tiles_down = tiles;
  tiles_down.order = Imf::DECREASING_Y;
  out.push_back({"tiles-downwards", {tiles_down}});
  TestPart mip = tiles;
  mip.tiles = Imf::TileDescription(16, 8, Imf::MIPMAP_LEVELS);
  out.push_back({"mipmap", {mip}});
  TestPart rip = tiles;
  rip.tiles = Imf::TileDescription(16, 8, Imf::RIPMAP_LEVELS, Imf::ROUND_UP);
  out.push_back({"ripmap", {rip}});
  out.push_back({"parts",
                 {part_of("left", rgba_half), part_of("depth", {{"Z", PixelType::float32}}),
                  part_of("right", mixed_types)}});
  return out;
}

/// Every channel of every picture, but those named.
void expect_same_bits(const std::string& a, const std::string& b, const std::vector<std::string>& but = {}) {
  ExrSource source(a, Limits());
  for (const Subimage& p : source.subimages())
    for (const Channel& channel : p.channels) {
      if (std::find(but.begin(), but.end(), channel.name) != but.end()) continue;
      EXPECT_EQ(read_bits(a, p.part, p.level_x, p.level_y, channel.name),
                read_bits(b, p.part, p.level_x, p.level_y, channel.name))
          << p.name << " " << channel.name << " level " << p.level_x << "," << p.level_y;
    }
}

/// Every attribute of every header; those of `b` that are stamps aside.
void expect_same_headers(const std::string& a, const std::string& b) {
  Imf::MultiPartInputFile first(a.c_str()), second(b.c_str());
  ASSERT_EQ(first.parts(), second.parts());
  for (int p = 0; p < first.parts(); ++p) {
    const Imf::Header& header = first.header(p);
    for (auto it = header.begin(); it != header.end(); ++it) {
      const auto found = second.header(p).find(it.name());
      ASSERT_TRUE(found != second.header(p).end()) << "part " << p << " lost " << it.name();
      EXPECT_STREQ(found.attribute().typeName(), it.attribute().typeName()) << it.name();
    }
    EXPECT_EQ(header.dataWindow(), second.header(p).dataWindow());
    EXPECT_EQ(header.displayWindow(), second.header(p).displayWindow());
    EXPECT_EQ(header.compression(), second.header(p).compression());
    EXPECT_EQ(header.lineOrder(), second.header(p).lineOrder());
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
      const Imf::Channel* found = second.header(p).channels().findChannel(it.name());
      ASSERT_NE(found, nullptr) << it.name();
      EXPECT_TRUE(*found == it.channel()) << it.name();
    }
    if (header.hasTileDescription()) {
      EXPECT_TRUE(header.tileDescription() == second.header(p).tileDescription());
    }
  }
}

TEST(ApplyImage, a_photopic_scene_comes_back_bit_for_bit_in_every_layout) {
  for (const auto& [name, parts] : layouts()) {
    SCOPED_TRACE(name);
    const std::string in = temporary(name + ".exr");
    const std::string out = temporary(name + "-out.exr");
    write_exr(in, parts);
    run_operator(in, out, 5.0);
    expect_same_bits(in, out);
    expect_same_headers(in, out);
  }
}

TEST(ApplyImage, in_the_dark_only_colour_changes) {
  for (auto [name, parts] : layouts()) {
    SCOPED_TRACE(name);
    for (TestPart& part : parts) part.finite = true;
    const std::string in = temporary(name + ".exr");
    const std::string out = temporary(name + "-out.exr");
    write_exr(in, parts);
    run_operator(in, out, 0.01);
    expect_same_bits(in, out, {"R", "G", "B"});
    expect_same_headers(in, out);
    for (const char* channel : {"R", "G", "B"})
      EXPECT_NE(read_bits(in, 0, 0, 0, channel), read_bits(out, 0, 0, 0, channel));
  }
}

TEST(ApplyImage, bytes_do_not_depend_on_the_number_of_threads) {
  TestPart part = part_of("", mixed_types);
  part.data = {0, 0, 300, 211};
  part.finite = true;
  const std::string in = temporary("in.exr");
  write_exr(in, {part});
  std::string first;
  for (const int threads : {1, 2, 7}) {
    set_threads(threads);
    const std::string out = temporary("out.exr");
    run_operator(in, out, 0.02);
    if (first.empty()) first = file_bytes(out);
    EXPECT_EQ(file_bytes(out), first) << threads << " threads";
  }
  set_threads(0);
}

TEST(ApplyImage, tiles_and_scanlines_of_one_picture_give_the_same_pixels) {
  TestPart part = part_of("", rgba_half);
  part.data = {0, 0, 130, 117};
  part.finite = true;
  write_exr(temporary("lines.exr"), {part});
  part.tiles = Imf::TileDescription(64, 32);
  write_exr(temporary("tiles.exr"), {part});
  run_operator(temporary("lines.exr"), temporary("lines-out.exr"), 0.02);
  run_operator(temporary("tiles.exr"), temporary("tiles-out.exr"), 0.02);
  expect_same_bits(temporary("lines-out.exr"), temporary("tiles-out.exr"));
}

TEST(ApplyImage, a_file_may_be_written_over_itself) {
  TestPart part = part_of("", rgba_half);
  part.finite = true;
  write_exr(temporary("in.exr"), {part});
  write_exr(temporary("same.exr"), {part});
  run_operator(temporary("in.exr"), temporary("out.exr"), 0.02);
  run_operator(temporary("same.exr"), temporary("same.exr"), 0.02);
  expect_same_bits(temporary("out.exr"), temporary("same.exr"));
}

TEST(ApplyImage, exposure_scales_the_result_and_nothing_else) {
  TestPart part =
      part_of("", {{"B", PixelType::float32}, {"G", PixelType::float32}, {"R", PixelType::float32}});
  part.finite = true;
  write_exr(temporary("in.exr"), {part});
  run_operator(temporary("in.exr"), temporary("plain.exr"), 0.02);
  ImageRequest request;
  request.exposure = 3;
  run_operator(temporary("in.exr"), temporary("bright.exr"), 0.02, request);
  const auto plain = read_bits(temporary("plain.exr"), 0, 0, 0, "G");
  const auto bright = read_bits(temporary("bright.exr"), 0, 0, 0, "G");
  for (std::size_t i = 0; i < plain.size(); ++i)
    ASSERT_EQ(std::bit_cast<float>(bright[i]), 8 * std::bit_cast<float>(plain[i]));
}

TEST(ApplyImage, lossy_compression_is_not_put_on_pixels_again) {
  TestPart part =
      part_of("", {{"B", PixelType::float32}, {"G", PixelType::float32}, {"R", PixelType::float32}});
  part.finite = true;
  part.compression = Imf::DWAB_COMPRESSION;
  write_exr(temporary("in.exr"), {part});
  run_operator(temporary("in.exr"), temporary("out.exr"), 10);
  expect_same_bits(temporary("in.exr"), temporary("out.exr"));
  EXPECT_EQ(ExrSource(temporary("out.exr"), Limits()).header(0).compression(), Imf::ZIP_COMPRESSION);
}

TEST(ApplyImage, receptor_signals_become_the_colour_that_they_are) {
  TestPart part = part_of("", {{"A", PixelType::half},
                               {"L", PixelType::float32},
                               {"M", PixelType::float32},
                               {"R", PixelType::float32},
                               {"S", PixelType::float32}});
  part.finite = true;
  write_exr(temporary("lmsr.exr"), {part});
  run_operator(temporary("lmsr.exr"), temporary("rgb.exr"), 10);  // photopic: conversion alone
  const auto bits = [&](const char* file, const char* name) {
    return read_bits(temporary(file), 0, 0, 0, name);
  };
  const auto l = bits("lmsr.exr", "L"), m = bits("lmsr.exr", "M"), s = bits("lmsr.exr", "S");
  const auto r = bits("rgb.exr", "R"), g = bits("rgb.exr", "G"), b = bits("rgb.exr", "B");
  EXPECT_EQ(bits("rgb.exr", "A"), bits("lmsr.exr", "A"));
  EXPECT_TRUE(bits("rgb.exr", "L").empty());
  const Matrix3<double> rgb_from_lms = inverse(gamut_xyz_matrix("rec709").value()) * xyz_from_lms();
  double worst = 0;
  for (std::size_t i = 0; i < l.size(); ++i) {
    const auto value = [&](const std::vector<std::uint32_t>& v) {
      return static_cast<double>(std::bit_cast<float>(v[i]));
    };
    const Vec3<double> expected = rgb_from_lms * Vec3<double>{value(l), value(m), value(s)};
    const double size = std::max({std::abs(expected[0]), std::abs(expected[1]), std::abs(expected[2])});
    const Vec3<double> got = {value(r), value(g), value(b)};
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(got[c] - expected[c]) / size);
  }
  std::printf("worst error of RGB from LMS: %.2g of the largest component\n", worst);
  EXPECT_LE(worst, 1e-7);  // one rounding to float
}

TEST(ApplyImage, a_grey_picture_becomes_colour_and_keeps_its_bits_by_day) {
  write_exr(temporary("grey.exr"), {part_of("", {{"Y", PixelType::half}})});
  run_operator(temporary("grey.exr"), temporary("out.exr"), 10);
  for (const char* channel : {"R", "G", "B"})
    EXPECT_EQ(read_bits(temporary("out.exr"), 0, 0, 0, channel),
              read_bits(temporary("grey.exr"), 0, 0, 0, "Y"));
}

TEST(ApplyImage, another_type_and_space_can_be_asked_for) {
  TestPart part = part_of("", rgba_half);
  part.finite = true;
  write_exr(temporary("in.exr"), {part});
  ImageRequest request;
  request.type = PixelType::float32;
  request.output_colourspace = "ACEScg";
  run_operator(temporary("in.exr"), temporary("out.exr"), 10, request);
  ExrSource out(temporary("out.exr"), Limits());
  ASSERT_TRUE(out.subimages()[0].colour.primaries.has_value());
  EXPECT_EQ(match_primaries(*out.subimages()[0].colour.primaries)->name, "ap1");
  for (const Channel& channel : out.subimages()[0].channels)
    EXPECT_EQ(channel.type, channel.name == "A" ? PixelType::half : PixelType::float32) << channel.name;
  // And back: what the file states about itself is enough.
  request.type = PixelType::half;
  request.output_colourspace = "Linear";
  run_operator(temporary("out.exr"), temporary("back.exr"), 10, request);
  const auto before = read_bits(temporary("in.exr"), 0, 0, 0, "G"),
             after = read_bits(temporary("back.exr"), 0, 0, 0, "G");
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_NEAR(static_cast<double>(after[i]), static_cast<double>(before[i]), 1) << "half ulp, pixel " << i;
}

TEST(ApplyImage, a_file_cut_short_anywhere_is_an_error_and_leaves_nothing) {
  TestPart part = part_of("", rgba_half);
  part.data = part.display = {0, 0, 16, 40};
  write_exr(temporary("whole.exr"), {part});
  const std::string whole = file_bytes(temporary("whole.exr"));
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    std::ofstream(temporary("cut.exr"), std::ios::binary) << whole.substr(0, size);
    try {
      run_operator(temporary("cut.exr"), temporary("out.exr"), 1);
      ADD_FAILURE() << size << " of " << whole.size() << " bytes were accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::input) << size << ": " << e.what();
    }
    ASSERT_FALSE(std::filesystem::exists(temporary("out.exr"))) << size;
  }
}

TEST(ApplyImage, limits_hold_before_pixels_are_read) {
  write_exr(temporary("in.exr"), {part_of("", rgba_half)});
  Limits limits;
  limits.pixels = 1000;
  try {
    open_source(temporary("in.exr"), limits);
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::limit);
    EXPECT_NE(std::string(e.what()).find("--max-pixels"), std::string::npos) << e.what();
  }
}

TEST(ApplyImage, log_average_leaves_out_what_is_not_finite) {
  TestPart part =
      part_of("", {{"B", PixelType::float32}, {"G", PixelType::float32}, {"R", PixelType::float32}});
  write_exr(temporary("in.exr"), {part});  // random bits: some are NaN or Inf
  const ColourConfig config = ColourConfig::own();
  const auto source = open_source(temporary("in.exr"), Limits());
  const ImageLayout layout = plan_layout(*source, "out.exr", config, {});
  AppearanceParameters parameters;
  parameters.xyz_from_rgb = config.xyz_from_working();
  const SceneStatistics statistics = measure_image(*source, layout, config, parameters);
  EXPECT_GT(statistics.non_finite, 0u);
  EXPECT_EQ(statistics.non_finite + statistics.finite(), 37u * 50u);
  EXPECT_TRUE(std::isfinite(statistics.log_mean_luminance()));
}

}  // namespace
}  // namespace scotopic

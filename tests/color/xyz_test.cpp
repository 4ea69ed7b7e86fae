// OpenEXR files of CIE XYZ: they say so, and are understood.
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "pipeline/apply_image.h"
#include "support/exr_files.h"
#include "io/exr/exr_source.h"

namespace scotopic {
namespace {

using test::read_bits;
using test::run_operator;
using test::temporary;
using test::TestPart;
using test::write_exr;

const std::vector<Channel> rgb_float = {
    {"B", PixelType::float32}, {"G", PixelType::float32}, {"R", PixelType::float32}};

std::string picture(const std::string& name) {
  TestPart part;
  part.channels = rgb_float;
  part.finite = true;
  write_exr(temporary(name), {part});
  return temporary(name);
}

std::string as_xyz(const std::string& in, const std::string& name) {
  ImageRequest request;
  request.output_colourspace = "CIE XYZ-D65";
  run_operator(in, temporary(name), 10, request);  // photopic: conversion alone
  return temporary(name);
}

std::vector<double> values(const std::string& file, const char* channel) {
  std::vector<double> out;
  for (const std::uint32_t bits : read_bits(file, 0, 0, 0, channel))
    out.push_back(double{std::bit_cast<float>(bits)});
  return out;
}

TEST(Xyz, output_states_the_chromaticities_of_xyz_and_the_white_of_d65) {
  const std::string file = as_xyz(picture("in.exr"), "xyz.exr");
  const ExrSource source(file, Limits());
  const Imf::Header& header = source.header(0);
  ASSERT_TRUE(Imf::hasChromaticities(header));
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  EXPECT_EQ(c.red, Imath::V2f(1, 0));
  EXPECT_EQ(c.green, Imath::V2f(0, 1));
  EXPECT_EQ(c.blue, Imath::V2f(0, 0));
  EXPECT_EQ(c.white, Imath::V2f(1.0f / 3, 1.0f / 3));
  ASSERT_TRUE(Imf::hasAdoptedNeutral(header));
  EXPECT_EQ(Imf::adoptedNeutral(header), Imath::V2f(0.3127f, 0.3290f));
  // By OpenEXR's own reading of these chromaticities the channels are X, Y, Z.
  const Imath::M44f to_xyz = Imf::RGBtoXYZ(c, 1.0f);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(to_xyz[i][j], i == j ? 1.0f : 0.0f, 1e-6f);
}

TEST(Xyz, channels_hold_x_y_z) {
  const std::string in = picture("in.exr"), out = as_xyz(in, "xyz.exr");
  const Matrix3<double> m = gamut_xyz_matrix("rec709").value();
  const auto r = values(in, "R"), g = values(in, "G"), b = values(in, "B");
  const auto x = values(out, "R"), y = values(out, "G"), z = values(out, "B");
  for (std::size_t i = 0; i < r.size(); ++i) {
    const Vec3<double> xyz = m * Vec3<double>{r[i], g[i], b[i]};
    EXPECT_NEAR(x[i], xyz[0], 2e-6 * xyz[0]);
    EXPECT_NEAR(y[i], xyz[1], 2e-6 * xyz[1]);
    EXPECT_NEAR(z[i], xyz[2], 2e-6 * xyz[2]);
  }
}

TEST(Xyz, what_a_file_states_about_itself_is_enough_to_come_back) {
  const std::string in = picture("in.exr"), xyz = as_xyz(in, "xyz.exr"), back = temporary("back.exr");
  ImageRequest request;
  request.output_colourspace = "Linear";
  const ImageLayout layout = run_operator(xyz, back, 10, request);
  EXPECT_EQ(layout.light.front().space.name, "CIE XYZ");
  for (const char* channel : {"R", "G", "B"}) {
    const auto before = values(in, channel), after = values(back, channel);
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(after[i], before[i], 1e-5 * std::abs(before[i]) + 1e-5);
  }
  EXPECT_FALSE(Imf::hasAdoptedNeutral(ExrSource(back, Limits()).header(0)));
}

TEST(Xyz, another_neutral_is_adapted_to_d65) {
  const std::string in = picture("in.exr"), xyz = as_xyz(in, "xyz.exr");
  ExrSource source(xyz, Limits());
  Imf::Header header = source.header(0);
  // Light whose white is equal energy: X = Y = Z is what the eye takes for white.
  Imf::addAdoptedNeutral(header, Imath::V2f(1.0f / 3, 1.0f / 3));
  TestPart part;
  part.channels = rgb_float;
  const std::string file = temporary("e.exr");
  {
    const Imath::Box2i w = header.dataWindow();
    const auto n = static_cast<std::size_t>(w.max.x - w.min.x + 1);
    const std::vector<float> white(n * static_cast<std::size_t>(w.max.y - w.min.y + 1), 0.5f);
    Imf::OutputFile out(file.c_str(), header);
    Imf::FrameBuffer frame;
    for (const char* channel : {"R", "G", "B"})
      frame.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(white.data())),
                                       sizeof(float), n * sizeof(float)));
    out.setFrameBuffer(frame);
    out.writePixels(w.max.y - w.min.y + 1);
  }
  ImageRequest request;
  request.output_colourspace = "Linear";
  run_operator(file, temporary("e-out.exr"), 10, request);
  for (const char* channel : {"R", "G", "B"})
    for (const double x : values(temporary("e-out.exr"), channel)) ASSERT_NEAR(x, 0.5, 1e-5);
}

}  // namespace
}  // namespace scotopic

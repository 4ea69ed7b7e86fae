// Which channels are light: data keep their bits and are not metered, and what is left alone is said.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfRgbaYca.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include "files/made_files.h"

namespace scotopic {
namespace {

using test::apply_parts;
using test::FlatChannel;
using test::FlatPart;
using test::says;

const std::vector<std::string> rgb_names = {"R", "G", "B"};

std::vector<FlatChannel> colours(const std::string& prefix, float r, float g, float b) {
  return {{prefix + "R", r}, {prefix + "G", g}, {prefix + "B", b}};
}

TEST(Channels, parts_of_data_keep_their_bits) {
  for (const char* name : {"crypto_object00", "normals", "depth", "VRayVelocity", "IndexOB", "Pworld",
                           "objectId", "motionvector"}) {
    const test::Run done =
        apply_parts({{"beauty", colours("", 0.4f, 0.2f, 0.1f)}, {name, colours("", 0.3f, -0.2f, 7)}});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(says(done.err, name)) << done.err;
    EXPECT_EQ(test::pixel_of(test::place("out.exr"), rgb_names, 1), (std::vector<float>{0.3f, -0.2f, 7}))
        << name;
    EXPECT_NE(test::pixel_of(test::place("out.exr"), rgb_names, 0)[0], 0.4f);
  }
}

TEST(Channels, data_are_not_metered) {
  const auto adaptation = [](const std::vector<FlatPart>& parts) {
    test::write_flat_exr(test::place("in.exr"), parts);
    const test::Run done = test::apply(test::place("in.exr"), test::place("out.exr"),
                                       {"--adaptation", "auto", "--white-luminance", "1"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return test::float_attribute(test::place("out.exr"), "scotopic:adaptation");
  };
  const FlatPart beauty = {"beauty", colours("", 0.4f, 0.2f, 0.1f)};
  EXPECT_EQ(adaptation({beauty, {"crypto_object00", colours("", 1e6f, 1e6f, 1e6f)}}),
            adaptation({beauty, {"normals", colours("", 1e-6f, 1e-6f, 1e-6f)}}));
}

TEST(Channels, integers_are_identifiers) {
  const test::Run done = apply_parts({{"", {{"R", 5, 0}, {"G", 6, 0}, {"B", 7, 0}}}});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(says(done.err, "R")) << done.err;
}

TEST(Channels, a_file_of_several_beauties_is_refused_with_their_names) {
  const test::Run done = apply_parts({{"key", colours("", 1, 1, 1)}, {"fill", colours("", 1, 1, 1)}});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_TRUE(says(done.err, "key, fill") && says(done.err, "--layer")) << done.err;
  EXPECT_EQ(apply_parts({{"key", colours("", 1, 1, 1)}, {"fill", colours("", 1, 1, 1)}}, {"--layer", "fill"})
                .exit_code,
            0);
}

TEST(Channels, of_passes_the_one_with_the_name_of_a_beauty_is_the_light) {
  std::vector<FlatChannel> channels = colours("ViewLayer.Combined.", 0.4f, 0.2f, 0.1f);
  for (const FlatChannel& c : colours("ViewLayer.DiffDir.", 0.3f, 0.2f, 0.1f)) channels.push_back(c);
  const test::Run done = apply_parts({{"", channels}});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(says(done.err, "ViewLayer.DiffDir")) << done.err;
  EXPECT_EQ(test::pixel_of(test::place("out.exr"), {"ViewLayer.DiffDir.R"})[0], 0.3f);
  EXPECT_NE(test::pixel_of(test::place("out.exr"), {"ViewLayer.Combined.R"})[0], 0.4f);
}

TEST(Channels, both_views_of_stereo_parts_are_light) {
  const auto view = [](const char* name) { return [=](Imf::Header& h) { h.setView(name); }; };
  ASSERT_EQ(apply_parts({{"a", colours("", 0.4f, 0.2f, 0.1f), view("left")},
                         {"b", colours("", 0.4f, 0.2f, 0.1f), view("right")}})
                .exit_code,
            0);
  EXPECT_EQ(test::pixel_of(test::place("out.exr"), rgb_names, 0),
            test::pixel_of(test::place("out.exr"), rgb_names, 1));
  EXPECT_NE(test::pixel_of(test::place("out.exr"), rgb_names, 0)[0], 0.4f);
}

TEST(Channels, colours_by_other_names_are_found) {
  const std::vector<std::vector<std::string>> names = {
      {"red", "green", "blue"}, {"beauty.red", "beauty.green", "beauty.blue"}, {"r", "g", "b"}};
  for (const std::vector<std::string>& n : names) {
    ASSERT_EQ(apply_parts({{"", {{n[0], 0.4f}, {n[1], 0.2f}, {n[2], 0.1f}}}}).exit_code, 0) << n[0];
    EXPECT_NE(test::pixel_of(test::place("out.exr"), {n[0]})[0], 0.4f) << n[0];
  }
}

TEST(Channels, a_grey_in_a_layer_is_read) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--layer", "Object_0"}}) {
    const test::Run done = apply_parts({{"", {{"Object_0.Y", 0.4f}}}}, more);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_GT(test::pixel_of(test::place("out.exr"), {"Object_0.G"})[0], 0);
  }
}

TEST(Channels, what_has_no_colour_is_refused_with_what_it_has) {
  const test::Run done = apply_parts({{"", {{"foo", 1}, {"bar.Z", 1}}}});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(says(done.err, "it has bar.Z, foo")) << done.err;
  const test::Run layer = apply_parts({{"", colours("", 1, 1, 1)}}, {"--layer", "diffuse"});
  EXPECT_EQ(layer.exit_code, 2);
  EXPECT_TRUE(says(layer.err, "it has B, G, R")) << layer.err;
}

TEST(Channels, luminance_and_chroma_are_read_as_colour) {
  {
    Imf::RgbaOutputFile out(test::place("in.exr").c_str(), 8, 8, Imf::WRITE_YC);
    const std::vector<Imf::Rgba> pixels(64, Imf::Rgba(1.0f, 0.2f, 0.05f));
    out.setFrameBuffer(pixels.data(), 1, 8);
    out.writePixels(8);
  }
  const test::Run done = test::apply(test::place("in.exr"), test::place("out.exr"), {"-d", "float"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::vector<float> p = test::pixel_of(test::place("out.exr"), rgb_names, 0, 4, 4);
  EXPECT_NEAR(p[0], 1.0f, 2e-3f);  // half, thrice
  EXPECT_NEAR(p[1], 0.2f, 1e-3f);
  EXPECT_NEAR(p[2], 0.05f, 2e-3f);
}

TEST(Channels, what_looks_like_bands_beside_colour_is_said) {
  for (const char* band : {"band1_x", "450nm", "400.00 nm", "refl.550"}) {
    std::vector<FlatChannel> channels = colours("", 0.4f, 0.2f, 0.1f);
    channels.push_back({band, 1});
    const test::Run done = apply_parts({{"", channels}});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(says(done.err, band)) << done.err;
  }
}

TEST(Channels, what_is_half_becomes_float_in_tiff_and_that_is_said) {
  test::write_flat_exr(test::place("in.exr"), {{"", {{"R", 1, 1}, {"G", 1, 1}, {"B", 1, 1}}}});
  const test::Run done = test::apply(test::place("in.exr"), test::place("out.tif"), test::night_options);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(says(done.err, "half becomes float")) << done.err;
}

TEST(Channels, data_windows_anywhere_are_written_in_every_format) {
  for (const int y : {-3, 0, 5})
    for (const char* out : {"out.exr", "out.tif", "out.png", "out.jpg"}) {
      test::write_flat_exr(test::place("in.exr"), {{"", colours("", 1, 0.5f, 0.25f), [=](Imf::Header& h) {
                                                      h.dataWindow() = {{-y, y}, {3 - y, 3 + y}};
                                                    }}});
      const test::Run done = test::apply(test::place("in.exr"), test::place(out), test::night_options);
      EXPECT_EQ(done.exit_code, 0) << out << " " << y << done.err;
    }
}

}  // namespace
}  // namespace scotopic

// Several layers of one file that are light: those of --layers, and the views of a stereo image in one part.
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cli/run_program.h"
#include "files/made_files.h"

namespace scotopic {
namespace {

using test::apply_parts;
using test::FlatChannel;
using test::FlatPart;
using test::says;
using Words = std::vector<std::string>;

const Words metered = {"--adaptation", "auto", "--white-luminance", "1"};

void add(std::vector<FlatChannel>& to, const std::string& prefix, const test::Rgb& rgb) {
  for (std::size_t c = 0; c < 3; ++c) to.push_back({prefix + "RGB"[c], static_cast<float>(rgb[c])});
}

/// A beauty at the top and passes of it, in one part.
std::vector<FlatChannel> passes() {
  std::vector<FlatChannel> out;
  add(out, "", {0.4, 0.2, 0.1});
  add(out, "diffuse.", {0.3, 0.1, 0.02});
  add(out, "specular.", {0.1, 0.1, 0.08});
  add(out, "normals.", {0.5, -0.5, 0.7});
  return out;
}

std::vector<float> colour(const std::string& layer, int part = 0, const std::string& file = "out.exr") {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  return test::pixel_of(test::place(file), {prefix + "R", prefix + "G", prefix + "B"}, part);
}

double adaptation_of(const std::vector<FlatPart>& parts, const Words& more) {
  const test::Run done = apply_parts(parts, more, metered);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  return test::float_attribute(test::place("out.exr"), "scotopic:adaptation");
}

TEST(Layers, those_listed_become_what_each_becomes_alone_and_the_others_keep_their_bits) {
  const std::vector<FlatPart> file = {{"", passes()}};
  for (const char* layer : {"diffuse", "specular"})
    ASSERT_EQ(
        apply_parts(file, {"--layer", layer}, test::night_options, std::string(layer) + ".exr").exit_code, 0);
  for (const char* list : {"diffuse,specular", "specular,diffuse", "diffuse,specular,diffuse"}) {
    const test::Run done = apply_parts(file, {"--layers", list});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(says(done.err, "light is diffuse, specular alike")) << done.err;
    EXPECT_TRUE(says(done.err, "left as they are (--layer takes another, --layers several): RGB, normals"))
        << done.err;
    for (const char* layer : {"diffuse", "specular"})
      EXPECT_EQ(colour(layer), colour(layer, 0, std::string(layer) + ".exr")) << list;
    EXPECT_NE(colour("diffuse")[0], 0.3f);
    EXPECT_EQ(colour(""), (std::vector<float>{0.4f, 0.2f, 0.1f}));
    EXPECT_EQ(colour("normals"), (std::vector<float>{0.5f, -0.5f, 0.7f}));
  }
}

TEST(Layers, of_parts_likewise) {
  const auto part = [](const char* name, const test::Rgb& rgb) {
    FlatPart out{name, {}};
    add(out.channels, "", rgb);
    return out;
  };
  const std::vector<FlatPart> file = {part("key", {0.4, 0.2, 0.1}), part("fill", {0.1, 0.1, 0.3}),
                                      part("crypto_object00", {7, 8, 9})};
  ASSERT_EQ(apply_parts(file, {"--layer", "fill"}, test::night_options, "fill.exr").exit_code, 0);
  const test::Run done = apply_parts(file, {"--layers", "key,fill"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(colour("", 1), colour("", 1, "fill.exr"));
  EXPECT_NE(colour("", 0)[0], 0.4f);
  EXPECT_EQ(colour("", 2), (std::vector<float>{7, 8, 9}));
}

TEST(Layers, the_eye_adapts_to_the_beauty_not_to_its_shares) {
  const std::vector<FlatPart> file = {{"", passes()}};
  EXPECT_EQ(adaptation_of(file, {"--layers", "RGB,diffuse,specular"}), adaptation_of(file, {}));
  std::vector<FlatChannel> grey;
  add(grey, "key.", {0.4, 0.4, 0.4});
  add(grey, "fill.", {0.1, 0.1, 0.1});
  // No beauty: the log-average of both, .4 * .1 under the root.
  EXPECT_NEAR(adaptation_of({{"", grey}}, {"--layers", "key,fill"}), 0.2, 1e-4);
}

TEST(Layers, grey_ones_become_colour_and_alpha_stays) {
  std::vector<FlatChannel> channels = {{"key.Y", 0.4f}, {"key.A", 0.5f}, {"fill.Y", 0.1f}};
  ASSERT_EQ(apply_parts({{"", channels}}, {"--layers", "key,fill"}).exit_code, 0);
  EXPECT_GT(colour("key")[2], 0);
  EXPECT_GT(colour("fill")[2], 0);
  EXPECT_EQ(test::pixel_of(test::place("out.exr"), {"key.A"})[0], 0.5f);
}

TEST(Layers, what_cannot_be_is_a_usage_error) {
  const std::vector<FlatPart> file = {{"", passes()}};
  const std::vector<std::pair<Words, std::string>> bad = {
      {{"--layers", "diffuse,specul"}, "did you mean specular"},
      {{"--layers", "diffuse,,specular"}, "--layers"},
      {{"--layers", "diffuse,"}, "--layers"},
      {{"--layers", ""}, "--layers"},
      {{"--layers", "diffuse", "--layer", "specular"}, "--layer"}};
  for (const auto& [arguments, text] : bad) {
    const test::Run done = apply_parts(file, arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments[1] << done.err;
    EXPECT_TRUE(says(done.err, text)) << done.err;
  }
  EXPECT_EQ(apply_parts(file, {"--layers", "diffuse,specular"}, test::night_options, "out.png").exit_code, 2);
  std::vector<FlatChannel> mixed = passes();
  for (const char* c : {"eye.L", "eye.M", "eye.S", "eye.R"}) mixed.push_back({c, 0.1f});
  EXPECT_EQ(apply_parts({{"", mixed}}, {"--layers", "diffuse,eye"}).exit_code, 2);
}

TEST(Layers, explain_and_lmsr_take_them_too) {
  const std::vector<FlatPart> file = {{"", passes()}};
  test::write_flat_exr(test::place("in.exr"), file);
  const test::Outcome told = test::run_program(
      {"explain", test::place("in.exr"), "--white-luminance", "1", "--layers", "diffuse,specular"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  const test::Outcome seen = test::run_program(
      {"lmsr", test::place("in.exr"), "-o", test::place("out.exr"), "--layers", "diffuse,specular"});
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  for (const std::string layer : {"diffuse", "specular"}) {
    ASSERT_EQ(
        test::run_program({"lmsr", test::place("in.exr"), "-o", test::place("one.exr"), "--layer", layer})
            .exit_code,
        0);
    const Words names = {layer + ".L", layer + ".M", layer + ".S", layer + ".R"};
    EXPECT_EQ(test::pixel_of(test::place("out.exr"), names), test::pixel_of(test::place("one.exr"), names));
  }
  EXPECT_EQ(colour("normals"), (std::vector<float>{0.5f, -0.5f, 0.7f}));
}

/// Layers a and b of 640 x 500 pixels in bands of which there are several, each a texture of its own.
void write_large(const std::string& file) {
  OIIO::ImageSpec spec(640, 500, 6, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"};
  spec.attribute("compression", "dwab");  // 256 rows at once
  std::vector<float> pixels;
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x)
      for (int c = 0; c < 6; ++c)
        pixels.push_back(0.2f + 0.01f * static_cast<float>((x * (c + 3) + y * (c < 3 ? 7 : 11)) % 13));
  const auto out = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(out && out->open(file, spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) &&
              out->close());
}

TEST(Layers, filters_look_around_within_each) {
  write_large(test::place("in.exr"));
  const auto go = [](Words more, const std::string& out) {
    for (const char* word : {"--adaptation", "0.01", "--white-luminance", "0.05", "--ppd", "10", "--effects",
                             "shift,detail,noise", "--fps", "24"})
      more.emplace_back(word);
    const test::Run done = test::apply(test::place("in.exr"), test::place(out), more);
    ASSERT_EQ(done.exit_code, 0) << done.err;
  };
  go({"--layers", "a,b"}, "both.exr");
  for (const std::string layer : {"a", "b"}) {
    go({"--layer", layer}, "one.exr");
    const Words names = {layer + ".R", layer + ".G", layer + ".B"};
    for (int i = 3; i < 500; i += 71)
      ASSERT_EQ(test::pixel_of(test::place("both.exr"), names, 0, i, i),
                test::pixel_of(test::place("one.exr"), names, 0, i, i))
          << layer << " at " << i;
  }
}

FlatPart stereo(const std::string& layer, const test::Rgb& left, const test::Rgb& right) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  FlatPart out{"", {}, [](Imf::Header& h) { Imf::addMultiView(h, {"left", "right"}); }};
  add(out.channels, prefix, left);
  add(out.channels, prefix + "right.", right);
  return out;
}

TEST(Layers, both_views_of_one_part_are_light) {
  for (const std::string layer : {"", "diffuse"}) {
    const test::Run done = apply_parts({stereo(layer, {0.4, 0.2, 0.1}, {0.4, 0.2, 0.1})}, {});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    EXPECT_TRUE(says(done.err, "alike; the eye adapts to all of them together")) << done.err;
    EXPECT_NE(colour(layer)[0], 0.4f);
    EXPECT_EQ(colour(layer), colour(layer.empty() ? "right" : layer + ".right"));
  }
  EXPECT_NEAR(adaptation_of({stereo("", {0.4, 0.4, 0.4}, {0.1, 0.1, 0.1})}, {}), 0.2, 1e-4);
}

TEST(Layers, one_view_can_be_chosen) {
  const std::vector<FlatPart> file = {stereo("", {0.4, 0.2, 0.1}, {0.3, 0.2, 0.1})};
  ASSERT_EQ(apply_parts(file, {"--layer", "right"}).exit_code, 0);
  EXPECT_EQ(colour("")[0], 0.4f);
  EXPECT_NE(colour("right")[0], 0.3f);
  ASSERT_EQ(apply_parts(file, {"--layer", "left"}).exit_code, 0);
  EXPECT_NE(colour("")[0], 0.4f);
  EXPECT_EQ(colour("right")[0], 0.3f);
}

TEST(Layers, views_need_no_multi_view_where_their_names_leave_no_doubt) {
  FlatPart pair{"", {}}, lights{"", {}}, no_top{"", {}};
  for (const char* prefix : {"", "right."}) add(pair.channels, prefix, {0.4, 0.2, 0.1});
  for (const char* prefix : {"", "left.", "right."}) add(lights.channels, prefix, {0.4, 0.2, 0.1});
  for (const char* prefix : {"left.", "right."}) add(no_top.channels, prefix, {0.4, 0.2, 0.1});
  ASSERT_EQ(apply_parts({pair}, {}).exit_code, 0);
  EXPECT_NE(colour("right")[0], 0.4f);
  ASSERT_EQ(apply_parts({lights}, {}).exit_code, 0);  // lights on the left and on the right: passes
  EXPECT_EQ(colour("right")[0], 0.4f);
  EXPECT_EQ(colour("left")[0], 0.4f);
  ASSERT_EQ(apply_parts({no_top}, {}).exit_code, 0);
  EXPECT_NE(colour("left")[0], 0.4f);
  EXPECT_NE(colour("right")[0], 0.4f);
}

TEST(Layers, passes_of_both_views_as_parts_leave_the_beauty_of_both) {
  const auto part = [](const char* name, const char* view) {
    FlatPart out{name, {}, [=](Imf::Header& h) { h.setView(view); }};
    add(out.channels, "", {0.4, 0.2, 0.1});
    return out;
  };
  const test::Run done = apply_parts({part("beauty_left", "left"), part("beauty_right", "right"),
                                      part("diffuse_left", "left"), part("diffuse_right", "right")},
                                     {});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  for (int p = 0; p < 4; ++p) EXPECT_EQ(colour("", p)[0] == 0.4f, p > 1) << p;
}

}  // namespace
}  // namespace scotopic

// Scotopic.ofx in a host of the test's own: pixels are those that the program writes; a mistake is a status
// and a message.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>

#include "cli/run_program.h"
#include "ofx/scenes.h"
#include "scotopic/controls.h"

namespace scotopic::test {
namespace {

using ofx::ImageEffectStruct;
using ofx::PropertySetStruct;
using ofx::RectI;

TEST_F(Plugin, says_what_it_takes_and_has_a_control_for_every_parameter) {
  const ImageEffectStruct& d = host_.description();
  EXPECT_EQ(d.properties.text(ofx::property::label), "Scotopic");
  EXPECT_EQ(d.properties.count(ofx::property::contexts), 2u);
  EXPECT_EQ(d.properties.text(ofx::property::thread_safety), ofx::fully_safe);
  EXPECT_EQ(d.clips.size(), 2u);
  for (const Control& c : controls()) {
    ASSERT_EQ(d.params.params.count(c.name), 1u) << c.name;
    const ofx::ParamStruct& param = d.params.params.at(c.name);
    EXPECT_EQ(param.properties.text(ofx::property::hint), c.sentence);
    EXPECT_EQ(d.params.params.count(param.properties.text(ofx::property::parent)), 1u) << c.name;
    if (c.kind == Control::Kind::number) {
      EXPECT_LE(param.properties.number(ofx::property::least),
                param.properties.number(ofx::property::initial));
      EXPECT_GE(param.properties.number(ofx::property::greatest),
                param.properties.number(ofx::property::initial));
    }
  }
  EXPECT_GT(controls().size(), 30u);
}

TEST_F(Plugin, every_stage_depth_and_number_of_components_gives_the_programs_bytes) {
  std::size_t compared = 0;
  for (const int channels : {4, 3})
    for (const Depth depth : {Depth::float32, Depth::half}) {
      if (slowed_by_sanitizer && (channels == 4) != (depth == Depth::float32)) continue;
      const Picture picture(channels, depth);
      for (const Setting& setting : settings()) {
        const std::string out = temporary("ofx_out.exr");
        std::vector<std::string> words = {"apply", Picture::file(), "-o", out};
        words.insert(words.end(), setting.options.begin(), setting.options.end());
        const Outcome program = run_program(words);
        ASSERT_EQ(program.exit_code, 0) << program.err;
        const auto effect = instance(setting);
        // A frame that begins at (3, -5), as a host's may.
        const RectI frame = {3, -5, 3 + width, -5 + height};
        Clips clips(*effect, frame, frame, channels, depth);
        picture.put(Picture::file(), clips.source, 3, -5);
        HostImage expected(frame, channels, depth);
        picture.put(out, expected, 3, -5);
        if (setting.options.back().find("history") != std::string::npos) tick(*effect, "moving", false);
        ASSERT_EQ(render(host_, *effect, frame), ofx::ok) << setting.name;
        EXPECT_TRUE(same_pixels(clips.target, expected, frame))
            << setting.name << ", " << channels << " channels";
        EXPECT_TRUE(clips.target.padding_is_whole());
        compared += static_cast<std::size_t>(width * height * channels);
        host_.destroy(*effect);
      }
    }
  std::printf("%zu settings, %zu values: the program's bytes\n", settings().size(), compared);
}

TEST_F(Plugin, is_the_identity_where_nothing_is_called_for) {
  const RectI frame = {0, 0, width, height};
  for (const Setting& setting : settings()) {
    const auto effect = instance(setting);
    Clips clips(*effect, frame, frame, 4, Depth::float32);
    PropertySetStruct in, out;
    in.set(ofx::property::time, {7.0});
    const bool identity = host_.call(ofx::action::is_identity, effect.get(), &in, &out) == ofx::ok;
    EXPECT_EQ(identity, std::string(setting.name) == "nothing called for") << setting.name;
    if (identity) {
      EXPECT_EQ(out.text(ofx::property::name), ofx::source_clip);
      EXPECT_EQ(out.number(ofx::property::time), 7);
    }
    host_.destroy(*effect);
  }
}

TEST(PluginFaults, a_mistake_is_a_status_and_a_message) {
  TestHost host(SCOTOPIC_OFX);
  ASSERT_EQ(host.open(ofx::context::general), ofx::ok);
  const RectI frame = {0, 0, width, height};
  const auto fails = [&](const std::function<void(ImageEffectStruct&)>& set, const std::string& text) {
    const auto effect = host.instance();
    Clips clips(*effect, frame, frame, 4, Depth::float32);
    const PropertySetStruct whole = effect->properties;
    set(*effect);
    EXPECT_EQ(render(host, *effect, frame), ofx::failed) << text;
    const std::vector<std::string> said = host.take_messages();
    ASSERT_EQ(said.size(), 1u) << text;
    EXPECT_NE(said.front().find(text), std::string::npos) << said.front();
    effect->properties = whole;
    host.destroy(*effect);
  };
  fails([](auto& e) { e.params.params.at("illuminant").text = "neon"; }, "--illuminant: 'neon' is not");
  fails([](auto& e) { word(e, "glare", "all"); }, "glare needs pixels per degree");
  fails([](auto& e) { word(e, "scene", "auto"); }, "absolute luminance unknown");
  fails([](auto& e) { e.params.params.at("adaptation_history").text = "noon"; }, "--adaptation-history");
  fails([](auto& e) { e.clips.at(ofx::source_clip).has_image = false; }, "no image at this time");
  fails(
      [](auto& e) {
        e.clips.at(ofx::source_clip).image.set(ofx::property::components, {std::string("Alpha")});
      },
      "neither RGB nor RGBA");
  fails(
      [](auto& e) {
        e.clips.at(ofx::source_clip).image.set(ofx::property::pixel_depth, {std::string("OfxBitDepthByte")});
      },
      "neither of float nor of half");
  fails(
      [](auto& e) {
        e.clips.at(ofx::source_clip).image.set(ofx::property::bounds, {0, 0, 0, 0});
      },
      "no pixels");
  fails([](auto& e) { e.properties.values.erase(ofx::property::instance_data); }, "lost the instance's data");
}

TEST(PluginFaults, a_host_without_what_is_needed_is_told_at_loading) {
  for (const char* suite : {ofx::property_suite, ofx::image_effect_suite, ofx::parameter_suite}) {
    TestHost host(SCOTOPIC_OFX, suite);
    EXPECT_EQ(host.open(), ofx::missing_feature) << suite;
  }
  for (const char* suite : {ofx::memory_suite, ofx::multi_thread_suite}) {
    TestHost host(SCOTOPIC_OFX, suite);
    EXPECT_EQ(host.open(), ofx::ok) << suite;
  }
  TestHost silent(SCOTOPIC_OFX, ofx::message_suite);
  EXPECT_EQ(silent.open(), ofx::ok);
  EXPECT_EQ(silent.call("OfxActionSomethingOfNextYear", nullptr), ofx::reply_default);
}

}  // namespace
}  // namespace scotopic::test

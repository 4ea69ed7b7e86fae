// Colour management of OpenFX 1.5: the host says which space the source is in, and is told the output's.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "cli/run_program.h"
#include "ofx/scenes.h"

namespace scotopic::test {
namespace {

using ofx::ImageEffectStruct;
using ofx::PropertySetStruct;
using ofx::RectI;

constexpr RectI frame = {0, 0, width, height};

/// A host that offers what `style` says; one of 1.4 where it is empty.
class HostOf {
 public:
  explicit HostOf(const std::string& style) : host(SCOTOPIC_OFX) {
    host.offer_colour(style);
    EXPECT_EQ(host.open(), ofx::ok);
  }
  /// With the host's word on the source's space.
  std::unique_ptr<ImageEffectStruct> instance(const std::string& space) {
    auto out = host.instance();
    word(*out, "scene", "street");
    if (!space.empty()) out->clips.at(ofx::source_clip).properties.set(ofx::property::colourspace, {space});
    return out;
  }
  TestHost host;
};

/// What the program makes of the picture, always the same, with these options.
HostImage by_program(const Picture& picture, const std::vector<std::string>& options) {
  static std::map<std::vector<std::string>, HostImage> made;
  if (const auto known = made.find(options); known != made.end()) return known->second;
  const std::string out = temporary("ofx_colour_out.exr");
  std::vector<std::string> words = {"apply", Picture::file(), "-o", out, "--adaptation=street"};
  words.insert(words.end(), options.begin(), options.end());
  const Outcome outcome = run_program(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  HostImage image(frame, 4, Depth::float32);
  picture.put(out, image, 0, 0);
  made.emplace(options, image);
  return image;
}

HostImage by_plugin(const Picture& picture, const TestHost& host, ImageEffectStruct& effect) {
  Clips clips(effect, frame, frame, 4, Depth::float32);
  picture.put(Picture::file(), clips.source, 0, 0);
  EXPECT_EQ(render(host, effect, frame), ofx::ok);
  return clips.target;
}

TEST(ColourManagement, is_declared_to_hosts_that_offer_it) {
  for (const char* style : {"", ofx::colour::none, ofx::colour::basic, ofx::colour::core,
                            "OfxImageEffectColourManagementFull", "OfxImageEffectColourManagementOCIO"}) {
    HostOf offer(style);
    const PropertySetStruct& said = offer.host.description().properties;
    const bool offered = *style != 0 && std::string(style) != ofx::colour::none;
    EXPECT_EQ(said.text(ofx::property::colour_style), offered ? ofx::colour::core : "") << style;
    EXPECT_EQ(said.text(ofx::property::colour_configs), offered ? ofx::colour::native_config : "") << style;
    EXPECT_EQ(said.text(ofx::property::clip_preferences_follow), "colorspace");
  }
}

TEST(ColourManagement, a_space_that_the_host_names_gives_the_programs_bytes) {
  struct Case {
    const char* style;
    const char* said;
    const char* space;  // of the program's --colorspace; empty: not given
  };
  const char* core = ofx::colour::core;
  const char* basic = ofx::colour::basic;
  const std::vector<Case> cases = {{core, "ACEScg", "ACEScg"},
                                   {core, "ACES2065-1", "ACES2065-1"},
                                   {core, "lin_rec709_srgb", "Linear Rec.709 (sRGB)"},
                                   {core, "lin_rec2020", "Linear Rec.2020"},
                                   {core, "lin_p3d65", "Linear P3-D65"},
                                   {core, "ACEScc", "ACEScc"},
                                   {core, "ACEScct", "ACEScct"},
                                   {core, "srgb_tx", "sRGB - Texture"},
                                   {core, "srgb_display", "sRGB - Display"},
                                   {core, "rec2100_pq_display", "Rec.2100-PQ - Display"},
                                   {core, "aces_interchange", "ACES2065-1"},
                                   {core, "cie_xyz_d65_interchange", "CIE-XYZ-D65"},
                                   {core, "scene_linear", ""},
                                   {core, "ofx_scene_linear", ""},
                                   {core, "", ""},
                                   {basic, "ofx_scene_linear", ""},
                                   {"OfxImageEffectColourManagementFull", "ACEScg", "ACEScg"},
                                   // Without an agreement nobody looks at it.
                                   {"", "ACEScg", ""},
                                   {ofx::colour::none, "ACEScg", ""}};
  const Picture picture(4, Depth::float32);
  HostImage unasked = by_program(picture, {});
  int others = 0;
  for (const Case& c : cases) {
    HostOf offer(c.style);
    const auto effect = offer.instance(c.said);
    HostImage made = by_plugin(picture, offer.host, *effect);
    std::vector<std::string> options;
    if (*c.space) options.push_back(std::string("--colorspace=") + c.space);
    HostImage expected = by_program(picture, options);
    EXPECT_TRUE(same_pixels(made, expected, frame)) << c.style << " " << c.said;
    others += !same_pixels(made, unasked, frame);
    offer.host.destroy(*effect);
    EXPECT_TRUE(offer.host.take_messages().empty());
  }
  EXPECT_EQ(others, 12) << "spaces that are not the working space";
  std::printf("%zu identifiers: the program's bytes\n", cases.size());
}

TEST(ColourManagement, a_choice_in_the_panel_is_heeded_before_the_host) {
  const Picture picture(4, Depth::float32);
  for (const char* said : {"ACEScct", "ofx_raw"}) {
    HostOf offer(ofx::colour::core);
    const auto effect = offer.instance(said);
    word(*effect, "colorspace", "ACEScg");
    HostImage made = by_plugin(picture, offer.host, *effect);
    HostImage expected = by_program(picture, {"--colorspace=ACEScg"});
    EXPECT_TRUE(same_pixels(made, expected, frame));
    word(*effect, "colorspace", "working space");
    made = by_plugin(picture, offer.host, *effect);
    expected = by_program(picture, {});
    EXPECT_TRUE(same_pixels(made, expected, frame));
    offer.host.destroy(*effect);
  }
}

TEST(ColourManagement, a_space_that_nothing_decodes_is_refused_by_its_name) {
  HostOf offer(ofx::colour::core);
  for (const char* said :
       {"g22_rec709_tx", "st2084_p3d65_display", "ofx_display_sdr", "ofx_display_hdr", "ofx_scene_log",
        "ofx_raw", "Raw", "data", "color_picking", "color_timing", "compositing_log", "matte_paint",
        "texture_paint", "OfxColourspace_Mask", "no_such_space"}) {
    const auto effect = offer.instance(said);
    Clips clips(*effect, frame, frame, 4, Depth::float32);
    EXPECT_EQ(render(offer.host, *effect, frame), ofx::failed) << said;
    const std::vector<std::string> messages = offer.host.take_messages();
    ASSERT_EQ(messages.size(), 1u) << said;
    EXPECT_NE(messages[0].find("the host's colour space '" + std::string(said) + "'"), std::string::npos)
        << messages[0];
    EXPECT_NE(messages[0].find("choose the space under Colorspace"), std::string::npos);
    offer.host.destroy(*effect);
  }
}

TEST(ColourManagement, scene_linear_light_is_asked_for_unless_the_panel_says_what_comes) {
  for (const char* style : {"", ofx::colour::basic, ofx::colour::core}) {
    HostOf offer(style);
    const auto effect = offer.instance("");
    PropertySetStruct out;
    const ofx::Status asks = *style ? ofx::ok : ofx::reply_default;
    EXPECT_EQ(offer.host.call(ofx::action::clip_preferences, effect.get(), nullptr, &out), asks);
    EXPECT_EQ(out.text(ofx::property::preferred_for_source), *style ? "ofx_scene_linear" : "");
    word(*effect, "colorspace", "ACEScct");
    EXPECT_EQ(offer.host.call(ofx::action::clip_preferences, effect.get(), nullptr, &out),
              ofx::reply_default);
    offer.host.destroy(*effect);
  }
}

/// What the host is told of the output.
std::string output_of(const TestHost& host, ImageEffectStruct& effect) {
  PropertySetStruct in, out;
  const ofx::Status status = host.call(ofx::action::output_colourspace, &effect, &in, &out);
  EXPECT_EQ(status == ofx::ok, out.count(ofx::property::colourspace) == 1);
  return out.text(ofx::property::colourspace);
}

TEST(ColourManagement, the_outputs_space_is_told_in_the_names_of_the_style) {
  struct Case {
    const char* parameter;
    const char* value;
    const char *core, *basic;
  };
  const std::vector<Case> cases = {
      {"exposure", "", "OfxColourspace_Source", "OfxColourspace_Source"},
      {"output_colorspace", "ACEScg", "OfxColourspace_Source", "OfxColourspace_Source"},
      {"output_colorspace", "Linear Rec.709 (sRGB)", "lin_rec709_srgb", "ofx_scene_linear"},
      {"output_colorspace", "ACEScct", "ACEScct", "ofx_scene_log"},
      {"output_colorspace", "V-Log V-Gamut", "ofx_scene_log", "ofx_scene_log"},
      {"output_colorspace", "CIE XYZ-D65", "ofx_scene_linear", "ofx_scene_linear"},
      {"output_colorspace", "sRGB - Texture", "srgb_tx", "ofx_display_sdr"},
      // To Raw nothing is converted: values stay the source's.
      {"output_colorspace", "Raw", "OfxColourspace_Source", "OfxColourspace_Source"},
      {"display", "night:sRGB - Display", "srgb_display", "ofx_display_sdr"},
      {"display", "night:Display P3 - Display", "displayp3_display", "ofx_display_sdr"},
      {"display", "Rec.2100-PQ - Display/Un-tone-mapped", "rec2100_pq_display", "ofx_display_hdr"},
      {"display", "sRGB - Display/Raw", "ofx_raw", "ofx_raw"}};
  for (const char* style : {ofx::colour::core, ofx::colour::basic, ""}) {
    const bool basic = style == ofx::colour::basic;
    HostOf offer(style);
    for (const Case& c : cases) {
      const auto effect = offer.instance(basic ? "ofx_scene_linear" : "ACEScg");
      if (basic) word(*effect, "colorspace", "ACEScg");
      if (*c.value) effect->params.params.at(c.parameter).text = c.value;
      const std::string expected = *style == 0 ? "" : basic ? c.basic : c.core;
      EXPECT_EQ(output_of(offer.host, *effect), expected) << style << " " << c.value;
      offer.host.destroy(*effect);
    }
  }
}

TEST(ColourManagement, an_output_that_cannot_be_is_not_told_and_the_render_says_why) {
  HostOf offer(ofx::colour::core);
  const auto effect = offer.instance("ACEScg");
  effect->params.params.at("output_colorspace").text = "no such space";
  EXPECT_EQ(output_of(offer.host, *effect), "");
  EXPECT_TRUE(offer.host.take_messages().empty());
  Clips clips(*effect, frame, frame, 4, Depth::float32);
  EXPECT_EQ(render(offer.host, *effect, frame), ofx::failed);
  EXPECT_EQ(offer.host.take_messages().size(), 1u);
  offer.host.destroy(*effect);
}

}  // namespace
}  // namespace scotopic::test

// Scotopic.ofx in a host of the test's own: pixels are those that the program writes; a mistake is a status
// and a message.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <functional>
#include <optional>
#include <thread>

#include "cli/run_program.h"
#include "scotopic/controls.h"
#include "ofx/host.h"
#include "support/exr_files.h"

namespace scotopic::test {
namespace {

using ofx::ImageEffectStruct;
using ofx::PropertySetStruct;
using ofx::RectI;

constexpr int width = 97, height = 61;

/// Values of the panel, and what they are as the program's options.
struct Setting {
  const char* name;
  std::function<void(ImageEffectStruct&)> set;
  std::vector<std::string> options;
  enum class Needs { pixel, halo, frame };
  Needs needs = Needs::pixel;  ///< what of the source a pixel depends on
};

void number(ImageEffectStruct& e, const std::string& name, double value) {
  ASSERT_EQ(e.params.params.count(name), 1u) << name;
  e.params.params.at(name).number = value;
}

void word(ImageEffectStruct& e, const std::string& name, const std::string& value) {
  ASSERT_EQ(e.params.params.count(name), 1u) << name;
  ofx::ParamStruct& param = e.params.params.at(name);
  const std::size_t count = param.properties.count(ofx::property::choice_option);
  for (std::size_t i = 0; i < count; ++i)
    if (param.properties.text(ofx::property::choice_option, i) == value) {
      param.integer = static_cast<int>(i);
      return;
    }
  FAIL() << name << " has no " << value;
}

void tick(ImageEffectStruct& e, const std::string& name, bool value) {
  ASSERT_EQ(e.params.params.count(name), 1u) << name;
  e.params.params.at(name).integer = value;
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = {
      {"slider", [](auto& e) { number(e, "log10_adaptation", -2); }, {"--adaptation=0.01"}},
      {"scene by name", [](auto& e) { word(e, "scene", "street"); }, {"--adaptation=street"}},
      {"metered",
       [](auto& e) { word(e, "scene", "auto"), number(e, "white_luminance", 2); },
       {"--adaptation=auto", "--white-luminance=2"},
       Setting::Needs::frame},
      {"strengths",
       [](auto& e) {
         word(e, "scene", "lane"), number(e, "strength", 0.7), number(e, "strength_chroma", 0.25);
       },
       {"--adaptation=lane", "--strength=0.7", "--strength-chroma=0.25"}},
      {"list of effects",
       [](auto& e) {
         word(e, "scene", "moon"), word(e, "effects", "listed");
         for (const char* off : {"use_luminance", "use_chroma", "use_detail", "use_glare", "use_noise"})
           tick(e, off, false);
       },
       {"--adaptation=moon", "--effects=shift"}},
      {"another model",
       [](auto& e) { word(e, "scene", "moon"), word(e, "model", "kirk2011"), word(e, "rods", "quadratic"); },
       {"--adaptation=moon", "--model=kirk2011", "--rods=quadratic"}},
      {"rod input by level",
       [](auto& e) { word(e, "scene", "street"), word(e, "model", "cao2008"); },
       {"--adaptation=street", "--model=cao2008"}},
      {"detail by contrast",
       [](auto& e) { word(e, "scene", "moon"), number(e, "ppd", 20); },
       {"--adaptation=moon", "--ppd=20"},
       Setting::Needs::halo},
      {"acuity",
       [](auto& e) { word(e, "scene", "moon"), number(e, "ppd", 20), word(e, "detail", "bilateral"); },
       {"--adaptation=moon", "--ppd=20", "--detail=bilateral"},
       Setting::Needs::halo},
      {"glare",
       [](auto& e) {
         word(e, "scene", "road"), number(e, "ppd", 10), word(e, "glare", "all"), number(e, "age", 70);
       },
       {"--adaptation=road", "--ppd=10", "--glare=all", "--age=70"},
       Setting::Needs::frame},
      {"everything, in a still",
       [](auto& e) {
         word(e, "scene", "starlight"), word(e, "effects", "all"), number(e, "fov", 5),
             tick(e, "moving", false);
       },
       {"--adaptation=starlight", "--effects=all", "--fov=5"},
       Setting::Needs::frame},
      {"daylight before",
       [](auto& e) {
         word(e, "scene", "moon"), e.params.params.at("adaptation_history").text = "1000:600,0.01:20";
       },
       {"--adaptation=moon", "--adaptation-history=1000:600,0.01:20"}},
      {"display",
       [](auto& e) { word(e, "scene", "street"), e.params.params.at("display").text = "night"; },
       {"--adaptation=street", "--display=night"},
       Setting::Needs::frame},
      {"tone map",
       [](auto& e) { word(e, "scene", "street"), word(e, "tone", "local"); },
       {"--adaptation=street", "--tone=local"},
       Setting::Needs::frame},
      {"a space",
       [](auto& e) {
         word(e, "scene", "street"), word(e, "colorspace", "ACEScg"), number(e, "exposure", 1.5);
       },
       {"--adaptation=street", "--colorspace=ACEScg", "--exposure=1.5"}},
      {"nothing called for", [](auto& e) { number(e, "log10_adaptation", 2); }, {"--adaptation=100"}},
  };
  return all;
}

/// A picture as the program reads and writes it.
class Picture {
 public:
  Picture(int channels, Depth depth) : channels_(channels) {
    const PixelType type = depth == Depth::half ? PixelType::half : PixelType::float32;
    size_ = depth == Depth::half ? 2 : 4;
    if (channels == 4) part_.channels.push_back({"A", type});
    for (const char* name : {"B", "G", "R"}) part_.channels.push_back({name, type});
    part_.finite = true;
    part_.data = part_.display = {0, 0, width, height};
    write_exr(file(), {part_});
  }
  static std::string file() { return temporary("ofx_in.exr"); }

  /// Its pixels, or those of another file, into a host's image whose frame begins at (x, y).
  void put(const std::string& from, HostImage& image, int x0, int y0) const {
    for (int c = 0; c < channels_; ++c) {
      const std::vector<std::uint32_t> bits = read_bits(from, 0, 0, 0, std::string(1, "RGBA"[c]));
      for (int y = std::max(0, image.bounds().y1 - y0); y < std::min(height, image.bounds().y2 - y0); ++y)
        for (int x = std::max(0, image.bounds().x1 - x0); x < std::min(width, image.bounds().x2 - x0); ++x)
          std::memcpy(image.at(x + x0, y + y0) + static_cast<std::size_t>(c) * size_,
                      &bits[static_cast<std::size_t>((height - 1 - y) * width + x)], size_);
    }
  }

 private:
  int channels_;
  std::size_t size_;
  TestPart part_;
};

ofx::Status render(const TestHost& host, ImageEffectStruct& effect, const RectI& window, double time = 0,
                   double scale = 1) {
  PropertySetStruct in, out;
  in.set(ofx::property::time, {time});
  in.set(ofx::property::render_window, {window.x1, window.y1, window.x2, window.y2});
  in.set(ofx::property::render_scale, {scale, scale});
  return host.call(ofx::action::render, &effect, &in, &out);
}

struct Clips {
  Clips(ImageEffectStruct& effect, const RectI& bounds, const RectI& frame, int channels, Depth depth)
      : source(bounds, channels, depth), target(bounds, channels, depth) {
    source.describe(effect.clips.at(ofx::source_clip).image, frame);
    target.describe(effect.clips.at(ofx::output_clip).image, frame);
    effect.clips.at(ofx::source_clip).definition = {
        static_cast<double>(frame.x1), static_cast<double>(frame.y1), static_cast<double>(frame.x2),
        static_cast<double>(frame.y2)};
  }
  HostImage source, target;
};

bool same_pixels(HostImage& a, HostImage& b, const RectI& window) {
  for (int y = window.y1; y < window.y2; ++y)
    if (std::memcmp(a.at(window.x1, y), b.at(window.x1, y),
                    static_cast<std::size_t>(window.x2 - window.x1) * a.pixel_bytes()) != 0)
      return false;
  return true;
}

class Plugin : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(host_.open(), ofx::ok); }
  void TearDown() override { EXPECT_TRUE(host_.take_messages().empty()); }
  std::unique_ptr<ImageEffectStruct> instance(const Setting& setting) {
    auto out = host_.instance();
    setting.set(*out);
    return out;
  }
  TestHost host_{SCOTOPIC_OFX};
};

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

/// What the plug-in asks of the source for a region; nullopt: the same.
std::optional<RectI> asked_for(const TestHost& host, ImageEffectStruct& effect, const RectI& region) {
  PropertySetStruct in, out;
  in.set(ofx::property::time, {0.0});
  in.set(ofx::property::region_of_interest, {static_cast<double>(region.x1), static_cast<double>(region.y1),
                                             static_cast<double>(region.x2), static_cast<double>(region.y2)});
  if (host.call(ofx::action::regions_of_interest, &effect, &in, &out) != ofx::ok) return std::nullopt;
  const auto side = [&](std::size_t i) {
    return static_cast<int>(out.number(ofx::property::source_region, i));
  };
  return RectI{side(0), side(1), side(2), side(3)};
}

bool same(const RectI& a, const RectI& b) {
  return a.x1 == b.x1 && a.y1 == b.y1 && a.x2 == b.x2 && a.y2 == b.y2;
}

TEST_F(Plugin, tiles_are_pieces_of_the_whole_and_ask_for_their_halo_alone) {
  const Picture picture(4, Depth::float32);
  const RectI frame = {0, 0, width, height};
  for (const Setting& setting : settings()) {
    const auto effect = instance(setting);
    Clips whole(*effect, frame, frame, 4, Depth::float32);
    picture.put(Picture::file(), whole.source, 0, 0);
    ASSERT_EQ(render(host_, *effect, frame), ofx::ok);
    for (const RectI& tile : {RectI{4, 2, 20, 9}, RectI{80, 30, width, height}, RectI{10, 12, 31, 40}}) {
      const std::optional<RectI> asked = asked_for(host_, *effect, tile);
      ASSERT_EQ(asked.has_value(), setting.needs != Setting::Needs::pixel) << setting.name;
      if (asked) EXPECT_EQ(same(*asked, frame), setting.needs == Setting::Needs::frame) << setting.name;
      // Hosts bring what they were asked for, or more.
      for (const RectI& brought : {asked.value_or(tile), frame}) {
        Clips clips(*effect, brought, frame, 4, Depth::float32);
        picture.put(Picture::file(), clips.source, 0, 0);
        ASSERT_EQ(render(host_, *effect, tile), ofx::ok);
        EXPECT_TRUE(same_pixels(clips.target, whole.target, tile)) << setting.name;
      }
    }
    host_.destroy(*effect);
  }
}

/// Multiplies colour by alphas that change no digit, or makes those the alphas of an image.
void set_alphas(HostImage& image, bool multiply) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float rgba[4];
      std::memcpy(rgba, image.at(x, y), sizeof rgba);
      rgba[3] = std::array{1.0f, 0.5f, 0.25f, 0.125f}[static_cast<std::size_t>(x + 3 * y) % 4];
      for (int c = 0; multiply && c < 3; ++c) rgba[c] *= rgba[3];
      std::memcpy(image.at(x, y), rgba, sizeof rgba);
    }
}

// The program has no straight alpha in EXR: the reference is the same light, premultiplied.
TEST_F(Plugin, straight_alpha_is_multiplied_into_the_light_and_divided_out_again) {
  const Picture picture(4, Depth::float32);
  const RectI frame = {0, 0, width, height};
  for (const Setting& setting : settings()) {
    if (std::string(setting.name) == "display") continue;  // encodes after the division
    const auto straight = instance(setting), associated = instance(setting);
    Clips a(*straight, frame, frame, 4, Depth::float32), b(*associated, frame, frame, 4, Depth::float32);
    straight->clips.at(ofx::source_clip)
        .image.set(ofx::property::premultiplication, {std::string(ofx::unpremultiplied)});
    picture.put(Picture::file(), a.source, 0, 0);
    picture.put(Picture::file(), b.source, 0, 0);
    set_alphas(a.source, false);
    set_alphas(b.source, true);
    ASSERT_EQ(render(host_, *straight, frame), ofx::ok) << setting.name;
    ASSERT_EQ(render(host_, *associated, frame), ofx::ok) << setting.name;
    EXPECT_FALSE(same_pixels(a.target, b.target, frame)) << setting.name;
    set_alphas(a.target, true);
    EXPECT_TRUE(same_pixels(a.target, b.target, frame)) << setting.name;
    host_.destroy(*straight);
    host_.destroy(*associated);
  }
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

TEST_F(Plugin, a_proxy_has_as_many_degrees_as_the_picture) {
  const Picture picture(4, Depth::float32);
  const RectI frame = {0, 0, width, height};
  const auto full = host_.instance(), half = host_.instance();
  for (ImageEffectStruct* effect : {full.get(), half.get()})
    word(*effect, "scene", "moon"), word(*effect, "detail", "bilateral");
  number(*full, "ppd", 10);
  number(*half, "ppd", 20);
  Clips a(*full, frame, frame, 4, Depth::float32), b(*half, frame, frame, 4, Depth::float32);
  picture.put(Picture::file(), a.source, 0, 0);
  picture.put(Picture::file(), b.source, 0, 0);
  ASSERT_EQ(render(host_, *full, frame), ofx::ok);
  ASSERT_EQ(render(host_, *half, frame, 0, 0.5), ofx::ok);
  EXPECT_TRUE(same_pixels(a.target, b.target, frame));
}

TEST_F(Plugin, the_eye_follows_the_slider_in_time) {
  const Picture picture(4, Depth::float32);
  const RectI frame = {0, 0, width, height};
  const auto effect = host_.instance();
  effect->clips.at(ofx::source_clip).properties.set(ofx::property::frame_range, {0.0, 48.0});
  effect->params.params.at("log10_adaptation").animation = [](double t) { return t < 1 ? 2.0 : -2.0; };
  Clips clips(*effect, frame, frame, 4, Depth::float32);
  picture.put(Picture::file(), clips.source, 0, 0);
  ASSERT_EQ(render(host_, *effect, frame, 2), ofx::ok);
  HostImage at_once = clips.target;
  tick(*effect, "adapt_in_time", true);
  ASSERT_EQ(render(host_, *effect, frame, 2), ofx::ok);
  HostImage soon = clips.target;
  ASSERT_EQ(render(host_, *effect, frame, 48), ofx::ok);
  float sums[2] = {};
  for (int x = 0; x < width; ++x) {
    float value = 0;
    std::memcpy(&value, soon.at(x, 20), sizeof value);
    sums[0] += value;
    std::memcpy(&value, clips.target.at(x, 20), sizeof value);
    sums[1] += value;
  }
  EXPECT_FALSE(same_pixels(soon, at_once, frame));
  EXPECT_LT(sums[0], sums[1]) << "more is seen after two seconds than after one frame";
}

TEST_F(Plugin, threads_may_render_one_instance_at_once) {
  const Picture picture(4, Depth::float32);
  const RectI frame = {0, 0, width, height};
  const auto effect = instance(settings()[7]);
  Clips clips(*effect, frame, frame, 4, Depth::float32);
  picture.put(Picture::file(), clips.source, 0, 0);
  ASSERT_EQ(render(host_, *effect, frame), ofx::ok);
  HostImage expected = clips.target;
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i)
    threads.emplace_back([&, i] {
      EXPECT_EQ(render(host_, *effect, {0, i * 10, width, i * 10 + 10}), ofx::ok);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(same_pixels(clips.target, expected, frame));
}

TEST(PluginFaults, a_mistake_is_a_status_and_a_message) {
  TestHost host(SCOTOPIC_OFX);
  ASSERT_EQ(host.open(ofx::context::general), ofx::ok);
  const RectI frame = {0, 0, width, height};
  const auto fails = [&](const std::function<void(ImageEffectStruct&)>& set, const std::string& text) {
    const auto effect = host.instance();
    Clips clips(*effect, frame, frame, 4, Depth::float32);
    set(*effect);
    EXPECT_EQ(render(host, *effect, frame), ofx::failed) << text;
    const std::vector<std::string> said = host.take_messages();
    ASSERT_EQ(said.size(), 1u) << text;
    EXPECT_NE(said.front().find(text), std::string::npos) << said.front();
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
  TestHost silent(SCOTOPIC_OFX, ofx::message_suite);
  EXPECT_EQ(silent.open(), ofx::ok);
  EXPECT_EQ(silent.call("OfxActionSomethingOfNextYear", nullptr), ofx::reply_default);
}

}  // namespace
}  // namespace scotopic::test

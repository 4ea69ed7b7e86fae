// Parts of frames, alpha, proxies, time, and several threads.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <functional>
#include <optional>

#include "ofx/scenes.h"

namespace scotopic::test {
namespace {

using ofx::ImageEffectStruct;
using ofx::PropertySetStruct;
using ofx::RectI;

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
      const bool all = asked && same(*asked, frame);
      EXPECT_EQ(all, setting.needs == Setting::Needs::frame) << setting.name;
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
  host_.destroy(*full);
  host_.destroy(*half);
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
  host_.destroy(*effect);
}

TEST_F(Plugin, threads_may_render_one_instance_at_once) {
  const Picture picture(4, Depth::float32);
  const RectI frame = {0, 0, width, height};
  const auto effect = instance(settings()[7]);
  Clips clips(*effect, frame, frame, 4, Depth::float32);
  picture.put(Picture::file(), clips.source, 0, 0);
  ASSERT_EQ(render(host_, *effect, frame), ofx::ok);
  HostImage expected = clips.target;
  const std::function<void(int)> strip = [&](int i) {
    EXPECT_EQ(render(host_, *effect, {0, i * 10, width, i * 10 + 10}), ofx::ok);
  };
  const auto* threads = static_cast<const ofx::MultiThreadSuite*>(suite(nullptr, ofx::multi_thread_suite, 1));
  ASSERT_NE(threads, nullptr);
  const auto work = [](unsigned int index, unsigned int, void* what) {
    (*static_cast<const std::function<void(int)>*>(what))(static_cast<int>(index));
  };
  EXPECT_EQ(threads->multi_thread(work, 6, const_cast<std::function<void(int)>*>(&strip)), ofx::ok);
  EXPECT_TRUE(same_pixels(clips.target, expected, frame));
  host_.destroy(*effect);
}

}  // namespace
}  // namespace scotopic::test

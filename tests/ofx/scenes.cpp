#include "ofx/scenes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace scotopic::test {

using ofx::ImageEffectStruct;
using ofx::PropertySetStruct;
using ofx::RectI;

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
       [](auto& e) { word(e, "scene", "moon"), number(e, "ppd", 20), word(e, "glare", "none"); },
       {"--adaptation=moon", "--ppd=20", "--glare=none"},
       Setting::Needs::halo},
      {"acuity",
       [](auto& e) {
         word(e, "scene", "moon"), number(e, "ppd", 20), word(e, "detail", "bilateral"),
             word(e, "glare", "none");
       },
       {"--adaptation=moon", "--ppd=20", "--detail=bilateral", "--glare=none"},
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

Picture::Picture(int channels, Depth depth) : channels_(channels), size_(depth == Depth::half ? 2 : 4) {
  const PixelType type = depth == Depth::half ? PixelType::half : PixelType::float32;
  TestPart part;
  if (channels == 4) part.channels.push_back({"A", type});
  for (const char* name : {"B", "G", "R"}) part.channels.push_back({name, type});
  part.finite = true;
  part.data = part.display = {0, 0, width, height};
  write_exr(file(), {part});
}

void Picture::put(const std::string& from, HostImage& image, int x0, int y0) const {
  for (int c = 0; c < channels_; ++c) {
    const std::vector<std::uint32_t> bits = read_bits(from, 0, 0, 0, std::string(1, "RGBA"[c]));
    for (int y = std::max(0, image.bounds().y1 - y0); y < std::min(height, image.bounds().y2 - y0); ++y)
      for (int x = std::max(0, image.bounds().x1 - x0); x < std::min(width, image.bounds().x2 - x0); ++x)
        std::memcpy(image.at(x + x0, y + y0) + static_cast<std::size_t>(c) * size_,
                    &bits[static_cast<std::size_t>((height - 1 - y) * width + x)], size_);
  }
}

ofx::Status render(const TestHost& host, ImageEffectStruct& effect, const RectI& window, double time,
                   double scale) {
  PropertySetStruct in, out;
  in.set(ofx::property::time, {time});
  in.set(ofx::property::render_window, {window.x1, window.y1, window.x2, window.y2});
  in.set(ofx::property::render_scale, {scale, scale});
  return host.call(ofx::action::render, &effect, &in, &out);
}

Clips::Clips(ImageEffectStruct& effect, const RectI& bounds, const RectI& frame, int channels, Depth depth)
    : source(bounds, channels, depth), target(bounds, channels, depth) {
  source.describe(effect.clips.at(ofx::source_clip).image, frame);
  target.describe(effect.clips.at(ofx::output_clip).image, frame);
  effect.clips.at(ofx::source_clip).definition = {
      static_cast<double>(frame.x1), static_cast<double>(frame.y1), static_cast<double>(frame.x2),
      static_cast<double>(frame.y2)};
}

bool same_pixels(HostImage& a, HostImage& b, const RectI& window) {
  for (int y = window.y1; y < window.y2; ++y)
    if (std::memcmp(a.at(window.x1, y), b.at(window.x1, y),
                    static_cast<std::size_t>(window.x2 - window.x1) * a.pixel_bytes()) != 0)
      return false;
  return true;
}

}  // namespace scotopic::test

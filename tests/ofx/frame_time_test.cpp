// What a frame costs in a host, over what the operator itself takes for it. Not run by ctest: docs/hosts.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>

#include "host/operator.h"
#include "ofx/scenes.h"

namespace scotopic::test {
namespace {

constexpr int wide = 3840, high = 2160;
constexpr ofx::RectI frame_4k = {0, 0, wide, high};

/// A dark street with lamps, as a host has it: the last row first.
void fill(HostImage& image) {
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) {
      const float texture = static_cast<float>((x * 7 + y * 13) % 31) / 31;
      const float light = x % 480 < 6 && y % 360 < 6 ? 40.0f : 0.01f + 0.02f * texture;
      const float rgba[4] = {light, 0.7f * light, 0.4f * light, 1};
      std::memcpy(image.at(x, y), rgba, sizeof rgba);
    }
}

/// The options' names and values as parameters.
Parameters parameters_of(const Setting& setting) {
  Parameters out;
  for (const std::string& option : setting.options) {
    const std::size_t equals = option.find('=');
    std::string name = option.substr(2, equals - 2);
    std::replace(name.begin(), name.end(), '-', '_');
    out[name] = option.substr(equals + 1);
  }
  return out;
}

MemoryPixels pixels_of(HostImage& image) {
  MemoryPixels out;
  out.data = image.at(0, high - 1);
  out.width = wide;
  out.height = high;
  out.channels = 4;
  out.channel_stride = sizeof(float);
  out.pixel_stride = 4 * out.channel_stride;
  out.row_stride = image.at(0, 0) - image.at(0, 1);
  return out;
}

template <class Work>
double seconds(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// One after the other, so that a busy machine is busy for both.
void measure(const TestHost& host, ofx::ImageEffectStruct& effect, const Setting& setting, HostImage& source,
             HostImage& direct) {
  Clips clips(effect, frame_4k, frame_4k, 4, Depth::float32);
  clips.source = source;
  clips.source.describe(effect.clips.at(ofx::source_clip).image, frame_4k);
  const HostOperator op(parameters_of(setting));
  MemoryJob job;
  job.in = pixels_of(source);
  job.out = pixels_of(direct);
  job.header.data = job.header.display = job.window = {0, 0, wide, high};
  if (effect.params.params.at("moving").integer != 0) job.frame = 0;
  double plugin = std::numeric_limits<double>::max(), own = plugin;
  for (int i = 0; i < 3; ++i) {
    plugin = std::min(plugin, seconds([&] { ASSERT_EQ(render(host, effect, frame_4k), ofx::ok); }));
    own = std::min(own, seconds([&] { (void)op.apply(job, {}); }));
  }
  EXPECT_TRUE(same_pixels(clips.target, direct, frame_4k)) << setting.name;
  std::printf("| %-24s | %7.0f | %7.0f | %.2f |\n", setting.name, 1e3 * plugin, 1e3 * own, plugin / own);
}

TEST(FrameTime, DISABLED_of_4k_in_a_host_and_of_the_operator_alone) {
  TestHost host(SCOTOPIC_OFX);
  ASSERT_EQ(host.open(), ofx::ok);
  HostImage source(frame_4k, 4, Depth::float32), direct(frame_4k, 4, Depth::float32);
  fill(source);
  std::printf("| stages | in the host, ms | operator, ms | ratio |\n|---|---|---|---|\n");
  for (const Setting& setting : settings()) {
    const auto effect = host.instance();
    setting.set(*effect);
    measure(host, *effect, setting, source, direct);
    host.destroy(*effect);
  }
}

/// What filters work by is made for the first tile and kept for the others, which would make it twice each.
TEST(FrameTime, DISABLED_of_a_tile_and_of_what_its_filter_works_by) {
  TestHost host(SCOTOPIC_OFX);
  ASSERT_EQ(host.open(), ofx::ok);
  HostImage source(frame_4k, 4, Depth::float32);
  fill(source);
  std::printf(
      "| filter | tables, ms | tile of 256 x 256, ms | ratio with and without |\n|---|---|---|---|\n");
  for (const Setting& setting : settings()) {
    if (setting.needs != Setting::Needs::halo) continue;
    const HostOperator op(parameters_of(setting));
    MemoryJob job;
    job.in = pixels_of(source);
    job.header.data = job.header.display = {0, 0, wide, high};
    const double both = seconds([&] { (void)op.reach(job); });
    const double tables = both - seconds([&] { (void)op.reach(job); });
    const auto effect = host.instance();
    setting.set(*effect);
    Clips clips(*effect, frame_4k, frame_4k, 4, Depth::float32);
    clips.source = source;
    clips.source.describe(effect->clips.at(ofx::source_clip).image, frame_4k);
    double tile = std::numeric_limits<double>::max();
    for (int i = 0; i < 15; ++i)
      tile = std::min(tile, seconds([&] {
                        const ofx::RectI window = {256 * i, 512, 256 * i + 256, 768};
                        ASSERT_EQ(render(host, *effect, window), ofx::ok);
                      }));
    std::printf("| %-20s | %.2f | %.2f | %.2f |\n", setting.name, 1e3 * tables, 1e3 * tile,
                (tile + 2 * tables) / tile);
    host.destroy(*effect);
  }
}

}  // namespace
}  // namespace scotopic::test

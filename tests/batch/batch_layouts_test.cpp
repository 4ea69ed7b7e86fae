// Half and RGBA rows against float planes: the same results, rounded as Imath rounds.
#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "batch/batch.h"
#include "support/primaries.h"
#include "support/simd_targets.h"

namespace scotopic {
namespace {

AppearanceBatch night(Precision precision) {
  AppearanceParameters p;
  p.adaptation = 0.01;
  p.white_luminance = 0.05;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return AppearanceBatch(p, precision);
}

Imath::half from_bits(std::uint16_t bits) {
  Imath::half h;
  h.setBits(bits);
  return h;
}

float clamped(float x) { return std::isfinite(x) ? std::clamp(x, -65504.0f, 65504.0f) : x; }

// Every half there is, once as red, green and blue, beside others.
struct EveryHalf {
  std::vector<std::uint16_t> r, g, b;
  EveryHalf() {
    for (unsigned i = 0; i < 3 * 65536; ++i) {
      const auto bits = static_cast<std::uint16_t>(i);
      const auto other = static_cast<std::uint16_t>((i * 2654435761u) >> 17);  // positive, any size
      r.push_back(i / 65536 == 0 ? bits : other);
      g.push_back(i / 65536 == 1 ? bits : static_cast<std::uint16_t>(other / 2));
      b.push_back(i / 65536 == 2 ? bits : static_cast<std::uint16_t>(other / 3));
    }
  }
};

struct Expected {
  std::vector<std::uint16_t> r, g, b;
  std::vector<std::uint8_t> touched;
};

Expected through_floats(const AppearanceBatch& batch, const EveryHalf& in) {
  std::vector<float> planes[3];
  const std::vector<std::uint16_t>* halves[3] = {&in.r, &in.g, &in.b};
  for (int k = 0; k < 3; ++k)
    for (const std::uint16_t bits : *halves[k]) planes[k].push_back(static_cast<float>(from_bits(bits)));
  PixelRows rows;
  rows.r = planes[0].data(), rows.g = planes[1].data(), rows.b = planes[2].data(), rows.count = in.r.size();
  Expected out;
  out.touched.resize(rows.count);
  batch.apply(rows, out.touched.data());
  std::vector<std::uint16_t>* results[3] = {&out.r, &out.g, &out.b};
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < rows.count; ++i)
      results[k]->push_back(out.touched[i] ? Imath::half(clamped(planes[k][i])).bits() : (*halves[k])[i]);
  return out;
}

TEST(BatchLayouts, every_half_gives_what_float_planes_give_rounded_on_every_target) {
  const EveryHalf in;
  for (const Precision precision : {Precision::single, Precision::dual}) {
    const AppearanceBatch batch = night(precision);
    const Expected expected = through_floats(batch, in);
    test::on_every_target([&](const char* target) {
      EveryHalf out = in;
      std::vector<std::uint8_t> touched(out.r.size(), 9);
      batch.apply(HalfRows{out.r.data(), out.g.data(), out.b.data(), out.r.size()}, touched.data());
      EXPECT_TRUE(out.r == expected.r && out.g == expected.g && out.b == expected.b) << target;
      EXPECT_TRUE(touched == expected.touched) << target;
      EXPECT_GT(std::count(touched.begin(), touched.end(), 1), 50000) << target;
      EXPECT_GT(std::count(touched.begin(), touched.end(), 0), 50000) << target;
    });
  }
}

TEST(BatchLayouts, half_rgba_gives_what_half_planes_give_and_alpha_keeps_its_bits) {
  const EveryHalf in;
  const AppearanceBatch batch = night(Precision::single);
  EveryHalf planes = in;
  batch.apply(HalfRows{planes.r.data(), planes.g.data(), planes.b.data(), planes.r.size()});
  test::on_every_target([&](const char* target) {
    std::vector<std::uint16_t> rgba, expected;
    for (std::size_t i = 0; i < in.r.size(); ++i) {
      const auto alpha = static_cast<std::uint16_t>(i);
      rgba.insert(rgba.end(), {in.r[i], in.g[i], in.b[i], alpha});
      expected.insert(expected.end(), {planes.r[i], planes.g[i], planes.b[i], alpha});
    }
    batch.apply_rgba(rgba.data(), in.r.size());
    EXPECT_TRUE(rgba == expected) << target;
  });
}

TEST(BatchLayouts, float_rgba_gives_what_planes_give_for_any_count) {
  const AppearanceBatch batch = night(Precision::single);
  const float nan = std::bit_cast<float>(0x7fa12345u);  // signalling, with a payload
  for (const std::size_t count : {1u, 7u, 16u, 511u, 512u, 513u, 1041u}) {
    std::vector<float> r(count), g(count), b(count), rgba(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const float level = 1e-4f * static_cast<float>(1 + i * i % 997);
      r[i] = i % 17 == 3 ? nan : level, g[i] = i % 29 == 5 ? 1e4f : level * 0.5f, b[i] = -level * 0.1f;
      const float pixel[4] = {r[i], g[i], b[i], i % 2 ? nan : 0.5f};
      std::memcpy(&rgba[4 * i], pixel, sizeof pixel);
    }
    const std::vector<float> before = rgba;
    std::vector<std::uint8_t> touched(count), touched_planes(count);
    batch.apply_rgba(rgba.data(), count, touched.data());
    PixelRows rows;
    rows.r = r.data(), rows.g = g.data(), rows.b = b.data(), rows.count = count;
    batch.apply(rows, touched_planes.data());
    EXPECT_EQ(touched, touched_planes) << count;
    for (std::size_t i = 0; i < count; ++i) {
      const float pixel[3] = {r[i], g[i], b[i]};
      EXPECT_EQ(std::memcmp(&rgba[4 * i], pixel, sizeof pixel), 0) << count << " pixels, pixel " << i;
      EXPECT_EQ(std::memcmp(&rgba[4 * i + 3], &before[4 * i + 3], sizeof(float)), 0) << count << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace scotopic

// Half conversions against Imath's, over every half and around every point where rounding turns.
#include "batch/half_rows.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "support/simd_targets.h"

namespace scotopic {
namespace {

float value_of(unsigned bits) {
  Imath::half h;
  h.setBits(static_cast<std::uint16_t>(bits));
  return static_cast<float>(h);
}

std::uint16_t expected_half(float value) {
  if (std::isfinite(value)) value = std::clamp(value, -65504.0f, 65504.0f);
  return Imath::half(value).bits();
}

TEST(HalfRows, every_half_becomes_its_float_payloads_included) {
  std::vector<std::uint16_t> halves(65536);
  for (unsigned i = 0; i < 65536; ++i) halves[i] = static_cast<std::uint16_t>(i);
  test::on_every_target([&](const char* target) {
    std::vector<float> out(halves.size());
    floats_from_halves(halves.data(), halves.size(), out.data());
    for (unsigned i = 0; i < 65536; ++i)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i]), std::bit_cast<std::uint32_t>(value_of(i)))
          << target << ' ' << i;
    std::vector<std::uint16_t> back(halves.size());
    halves_from_floats(out.data(), out.size(), back.data());
    EXPECT_EQ(back, halves) << target;
  });
}

TEST(HalfRows, floats_round_as_imath_rounds_around_every_half_and_every_midpoint) {
  std::vector<float> values;
  const auto add_around = [&](float x) {
    for (const float y : {std::nextafter(x, -INFINITY), x, std::nextafter(x, INFINITY)})
      values.insert(values.end(), {y, -y});
  };
  for (unsigned i = 0; i < 0x7c00; ++i) {
    const float here = value_of(i), next = i + 1 < 0x7c00 ? value_of(i + 1) : 65536.0f;
    add_around(here);
    add_around(0.5f * (here + next));
  }
  for (const float x : {65520.0f, 1e5f, std::numeric_limits<float>::max(), std::numeric_limits<float>::min(),
                        std::numeric_limits<float>::denorm_min(), 0x1p-25f, 0x1p-26f})
    add_around(x);
  // Infinities and NaNs of every kind, each beside finite values.
  for (std::uint32_t payload = 0; payload < 0x800000; payload += 1 + payload / 7)
    for (const std::uint32_t sign : {0u, 0x80000000u}) {
      values.push_back(std::bit_cast<float>(sign | 0x7f800000u | payload));
      values.push_back(0.1f);
    }
  std::vector<std::uint16_t> expected;
  for (const float value : values) expected.push_back(expected_half(value));
  test::on_every_target([&](const char* target) {
    std::vector<std::uint16_t> out(values.size());
    halves_from_floats(values.data(), values.size(), out.data());
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(out[i], expected[i]) << target << ' ' << std::hexfloat << values[i];
  });
  std::printf("%zu floats compared\n", values.size());
}

TEST(HalfRows, any_count_writes_that_many) {
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<std::uint16_t> halves(41, 0x3c00), back(41, 7);
    std::vector<float> floats(41, -1.0f);
    floats_from_halves(halves.data(), count, floats.data());
    halves_from_floats(floats.data(), count, back.data());
    for (std::size_t i = 0; i < 41; ++i) {
      EXPECT_EQ(floats[i], i < count ? 1.0f : -1.0f) << count;
      EXPECT_EQ(back[i], i < count ? 0x3c00 : 7) << count;
    }
  }
}

}  // namespace
}  // namespace scotopic

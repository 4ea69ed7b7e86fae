#include "io/pixels/pixel_type.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace scotopic {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

template <typename T>
T stored(float value, PixelType type) {
  T out{};
  store_row(&value, 1, {reinterpret_cast<std::byte*>(&out), sizeof(T), type});
  return out;
}

TEST(PixelType, integers_are_rounded_to_nearest_and_clamped) {
  struct Row {
    float value;
    int eight;
    int sixteen;
  };
  for (const Row& row :
       {Row{0, 0, 0}, Row{1, 255, 65535}, Row{.5f, 128, 32768}, Row{-1, 0, 0}, Row{2, 255, 65535},
        Row{nan, 0, 0}, Row{inf, 255, 65535}, Row{-inf, 0, 0}, Row{.1f, 26, 6554}}) {
    EXPECT_EQ(stored<std::uint8_t>(row.value, PixelType::uint8), row.eight) << row.value;
    EXPECT_EQ(stored<std::uint16_t>(row.value, PixelType::uint16), row.sixteen) << row.value;
  }
}

TEST(PixelType, half_makes_no_infinity_of_a_finite_value) {
  EXPECT_EQ(stored<std::uint16_t>(1e9f, PixelType::half), 0x7bff);
  EXPECT_EQ(stored<std::uint16_t>(-65520.0f, PixelType::half), 0xfbff);
  EXPECT_EQ(stored<std::uint16_t>(inf, PixelType::half), 0x7c00);
  EXPECT_TRUE(Imath::half(Imath::half::FromBits, stored<std::uint16_t>(nan, PixelType::half)).isNan());
}

TEST(PixelType, every_integer_and_finite_half_comes_back_from_float) {
  for (int v = 0; v < 65536; ++v) {
    auto bits = static_cast<std::uint16_t>(v);
    float value = 0;
    load_row({reinterpret_cast<std::byte*>(&bits), 2, PixelType::uint16}, 1, &value);
    ASSERT_EQ(stored<std::uint16_t>(value, PixelType::uint16), v);
    load_row({reinterpret_cast<std::byte*>(&bits), 2, PixelType::half}, 1, &value);
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(stored<std::uint16_t>(value, PixelType::half), v);
  }
  for (int v = 0; v < 256; ++v) {
    auto byte = static_cast<std::uint8_t>(v);
    float value = 0;
    load_row({reinterpret_cast<std::byte*>(&byte), 1, PixelType::uint8}, 1, &value);
    ASSERT_EQ(stored<std::uint8_t>(value, PixelType::uint8), v);
  }
}

TEST(PixelType, kept_pixels_keep_bytes_that_no_conversion_would) {
  const std::vector<std::uint32_t> in = {0x7fa00001u, 0x00000001u, 0xff800000u,
                                         0x3f800000u};  // signalling NaN first
  std::vector<std::uint32_t> out = {1, 2, 3, 4};
  const std::uint8_t touched[4] = {0, 0, 1, 0};
  const auto row = [](const std::vector<std::uint32_t>& v) {
    return NativeRow{const_cast<std::byte*>(reinterpret_cast<const std::byte*>(v.data())), 4,
                     PixelType::float32};
  };
  copy_where_zero(touched, row(in), 4, row(out));
  EXPECT_EQ(out, (std::vector<std::uint32_t>{in[0], in[1], 3, in[3]}));
}

}  // namespace
}  // namespace scotopic

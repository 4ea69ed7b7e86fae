// Pixels as files hold them, and rows of them as float.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scotopic {

/// Types of a channel; half is IEEE 754 binary16.
enum class PixelType { uint8, uint16, uint32, half, float32 };

/// Bytes of one value.
std::size_t size_of(PixelType type);
/// uint8, uint16, uint, half, float.
std::string_view name_of(PixelType type);
/// Whether values are fractions of the type's largest.
inline bool is_integer(PixelType type) { return type < PixelType::half; }

/// One channel of one row: `stride` bytes from pixel to pixel.
struct NativeRow {
  std::byte* data = nullptr;
  std::ptrdiff_t stride = 0;
  PixelType type = PixelType::float32;
};

/// Floats from a row: uint8 and uint16 as 0..1; half and float exactly; uint32 rounded, its full range as
/// 0..1.
void load_row(const NativeRow& row, std::size_t count, float* out);

/// Whether any value is NaN or infinite; never one of an integer type.
bool any_non_finite(const NativeRow& row, std::size_t count);
bool any_non_finite(const float* values, std::size_t count);

/// A row from floats, rounded to nearest (ties to even). Integers: clamped to 0..1, NaN is 0. Half: finite
/// values beyond its range become its largest, so that no Inf is made; NaN and Inf stay.
void store_row(const float* values, std::size_t count, const NativeRow& row);

/// The very bytes of those pixels where keep[i] == 0; both rows have the same type.
void copy_where_zero(const std::uint8_t* keep, const NativeRow& from, std::size_t count, const NativeRow& to);

}  // namespace scotopic

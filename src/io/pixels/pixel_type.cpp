#include "io/pixels/pixel_type.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "batch/half_rows.h"

namespace scotopic {
namespace {

template <typename T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <typename T>
void store(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

/// Integers of T's full range from 0..1 in float.
template <typename T>
T quantise(float value) {
  constexpr double scale = static_cast<double>(static_cast<T>(~T{0}));
  if (!(value > 0)) return 0;  // NaN as well
  return static_cast<T>(std::nearbyint(std::min(1.0, static_cast<double>(value)) * scale));
}

template <typename Convert>
void each_load(const NativeRow& row, std::size_t count, float* out, Convert convert) {
  const std::byte* at = row.data;
  for (std::size_t i = 0; i < count; ++i, at += row.stride) out[i] = convert(at);
}

template <typename Convert>
void each_store(const float* values, std::size_t count, const NativeRow& row, Convert convert) {
  std::byte* at = row.data;
  for (std::size_t i = 0; i < count; ++i, at += row.stride) store(at, convert(values[i]));
}

// Halves that lie apart go through blocks that do not.
using HalfBlock = std::array<std::uint16_t, 256>;

void load_halves(const NativeRow& row, std::size_t count, float* out) {
  HalfBlock block;
  for (std::size_t at = 0; at < count; at += block.size()) {
    const std::size_t n = std::min(block.size(), count - at);
    const std::byte* from = row.data + static_cast<std::ptrdiff_t>(at) * row.stride;
    for (std::size_t i = 0; i < n; ++i, from += row.stride) block[i] = load<std::uint16_t>(from);
    floats_from_halves(block.data(), n, out + at);
  }
}

void store_halves(const float* values, std::size_t count, const NativeRow& row) {
  HalfBlock block;
  for (std::size_t at = 0; at < count; at += block.size()) {
    const std::size_t n = std::min(block.size(), count - at);
    halves_from_floats(values + at, n, block.data());
    std::byte* to = row.data + static_cast<std::ptrdiff_t>(at) * row.stride;
    for (std::size_t i = 0; i < n; ++i, to += row.stride) store(to, block[i]);
  }
}

/// Elements next to each other, where their type may be read and written.
bool packed(const NativeRow& row) {
  const std::size_t size = size_of(row.type);
  return row.stride == static_cast<std::ptrdiff_t>(size) &&
         reinterpret_cast<std::uintptr_t>(row.data) % size == 0;
}

template <typename T>
T* elements(const NativeRow& row) {
  return reinterpret_cast<T*>(row.data);
}

/// Whether all bits of `exponent` are set in any value: passes without branches, in vectors where values lie
/// together.
template <typename Bits>
bool any_has(Bits exponent, const NativeRow& row, std::size_t count) {
  Bits any = 0;
  const auto see = [&](Bits value) {
    any = static_cast<Bits>(any | static_cast<Bits>((value & exponent) == exponent));
  };
  if (packed(row)) {
    const Bits* values = elements<const Bits>(row);
    for (std::size_t i = 0; i < count; ++i) see(values[i]);
  } else {
    const std::byte* at = row.data;
    for (std::size_t i = 0; i < count; ++i, at += row.stride) see(load<Bits>(at));
  }
  return any != 0;
}

}  // namespace

std::size_t size_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return 1;
    case PixelType::uint16:
    case PixelType::half:
      return 2;
    case PixelType::uint32:
    case PixelType::float32:
      return 4;
  }
  return 0;
}

std::string_view name_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return "uint8";
    case PixelType::uint16:
      return "uint16";
    case PixelType::uint32:
      return "uint";
    case PixelType::half:
      return "half";
    case PixelType::float32:
      return "float";
  }
  return "";
}

bool any_non_finite(const NativeRow& row, std::size_t count) {
  if (row.type == PixelType::half) return any_has<std::uint16_t>(0x7c00, row, count);
  return row.type == PixelType::float32 && any_has<std::uint32_t>(0x7f800000, row, count);
}

bool any_non_finite(const float* values, std::size_t count) {
  std::uint32_t any = 0;
  for (std::size_t i = 0; i < count; ++i)
    any |= (std::bit_cast<std::uint32_t>(values[i]) & 0x7f800000u) == 0x7f800000u;
  return any != 0;
}

void load_row(const NativeRow& row, std::size_t count, float* out) {
  if (packed(row)) {
    if (row.type == PixelType::half)
      return floats_from_halves(elements<const std::uint16_t>(row), count, out);
    if (row.type == PixelType::float32) {
      std::memcpy(out, row.data, count * sizeof(float));
      return;
    }
  }
  switch (row.type) {
    case PixelType::uint8:
      return each_load(row, count, out,
                       [](const std::byte* p) { return static_cast<float>(load<std::uint8_t>(p)) / 255.0f; });
    case PixelType::uint16:
      return each_load(row, count, out, [](const std::byte* p) {
        return static_cast<float>(load<std::uint16_t>(p)) / 65535.0f;
      });
    case PixelType::uint32:
      return each_load(row, count, out, [](const std::byte* p) {
        return static_cast<float>(load<std::uint32_t>(p) / 4294967295.0);
      });
    case PixelType::half:
      return load_halves(row, count, out);
    case PixelType::float32:
      return each_load(row, count, out, [](const std::byte* p) { return load<float>(p); });
  }
}

void store_row(const float* values, std::size_t count, const NativeRow& row) {
  if (packed(row)) {
    if (row.type == PixelType::half) return halves_from_floats(values, count, elements<std::uint16_t>(row));
    if (row.type == PixelType::float32) {
      std::memcpy(row.data, values, count * sizeof(float));
      return;
    }
  }
  switch (row.type) {
    case PixelType::uint8:
      return each_store(values, count, row, quantise<std::uint8_t>);
    case PixelType::uint16:
      return each_store(values, count, row, quantise<std::uint16_t>);
    case PixelType::uint32:
      return each_store(values, count, row, quantise<std::uint32_t>);
    case PixelType::half:
      return store_halves(values, count, row);
    case PixelType::float32:
      return each_store(values, count, row, [](float v) { return v; });
  }
}

void copy_where_zero(const std::uint8_t* keep, const NativeRow& from, std::size_t count,
                     const NativeRow& to) {
  const std::size_t size = size_of(from.type);
  const std::byte* source = from.data;
  std::byte* target = to.data;
  for (std::size_t i = 0; i < count; ++i, source += from.stride, target += to.stride)
    if (keep[i] == 0) std::memcpy(target, source, size);
}

}  // namespace scotopic

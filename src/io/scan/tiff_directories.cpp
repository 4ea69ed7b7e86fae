#include "io/scan/tiff_directories.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "io/scan/file_bytes.h"

namespace scotopic {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint64_t most_entries = 4096, most_value = std::uint64_t{64} << 20;

// Field types (TIFF 6.0, section 2).
enum Type : std::uint64_t {
  rational = 5,
  int8 = 6,
  int16 = 8,
  int32 = 9,
  srational = 10,
  real = 11,
  real64 = 12
};

/// Bytes of a value of each field type.
std::uint64_t size_of_type(std::uint64_t type) {
  static constexpr std::uint8_t sizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
  return type < std::size(sizes) ? sizes[type] : 0;
}

double ratio(double a, double b) { return b == 0 ? 0 : a / b; }

/// A number of `size` bytes whose highest bit is a sign.
double with_sign(std::uint64_t value, std::uint64_t size) {
  const auto top = std::uint64_t{1} << (8 * size - 1);
  return static_cast<double>(value & ~top) - ((value & top) != 0 ? static_cast<double>(top) : 0.0);
}

}  // namespace

ReadBytes bytes_in_memory(std::span<const std::byte> block) {
  return [block](std::uint64_t at, std::uint64_t count) {
    if (at >= block.size()) return Bytes{};
    const auto piece = block.subspan(static_cast<std::size_t>(at));
    return Bytes(piece.begin(),
                 piece.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(count, piece.size())));
  };
}

TiffDirectories::TiffDirectories(ReadBytes read) : read_(std::move(read)) {
  const Bytes head = read_(0, 16);
  big_endian_ = !head.empty() && head[0] == std::byte{'M'};
  big_ = number_at(head, 2, 2, big_endian_) == 43;
  first_ = big_ ? number_at(head, 8, 8, big_endian_) : number_at(head, 4, 4, big_endian_);
}

std::vector<TiffDirectories::Field> TiffDirectories::fields(std::uint64_t directory,
                                                            std::uint64_t& next) const {
  const std::uint64_t count_size = big_ ? 8 : 2, entry = big_ ? 20 : 12, offset = big_ ? 8 : 4;
  const std::uint64_t count = std::min(number(directory, count_size), most_entries);
  std::vector<Field> out;
  const Bytes all = read_(directory + count_size, count * entry + offset);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t at = static_cast<std::size_t>(i * entry);
    Field field{number_at(all, at, 2, big_endian_), number_at(all, at + 2, 2, big_endian_),
                number_at(all, at + 4, static_cast<std::size_t>(offset), big_endian_), 0};
    const std::uint64_t inside = directory + count_size + i * entry + 4 + offset;
    const bool fits = field.count <= offset && size_of_type(field.type) * field.count <= offset;
    field.at = fits ? inside
                    : number_at(all, at + 4 + static_cast<std::size_t>(offset),
                                static_cast<std::size_t>(offset), big_endian_);
    out.push_back(field);
  }
  next =
      number_at(all, static_cast<std::size_t>(count * entry), static_cast<std::size_t>(offset), big_endian_);
  return out;
}

Bytes TiffDirectories::bytes(const Field& field) const {
  return read_(field.at, std::min(std::min(field.count, most_value) *
                                      std::max<std::uint64_t>(1, size_of_type(field.type)),
                                  most_value));
}

double TiffDirectories::value(const Field& field, std::size_t i) const {
  const std::uint64_t size = size_of_type(field.type), at = field.at + size * i;
  const auto whole = [&](std::uint64_t place) { return static_cast<double>(number(place, 4)); };
  switch (field.type) {
    case rational:
      return ratio(whole(at), whole(at + 4));
    case srational:
      return ratio(with_sign(number(at, 4), 4), with_sign(number(at + 4, 4), 4));
    case real:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(number(at, 4))));
    case real64:
      return std::bit_cast<double>(number(at, 8));
    case int8:
    case int16:
    case int32:
      return with_sign(number(at, size), size);
    default:
      return static_cast<double>(number(at, size));
  }
}

std::int64_t TiffDirectories::integer(const Field& field, std::size_t i) const {
  const double v = value(field, i);
  return std::abs(v) < 9007199254740992.0 ? static_cast<std::int64_t>(v) : 0;
}

std::uint64_t TiffDirectories::number(std::uint64_t at, std::uint64_t width) const {
  return number_at(read_(at, width), 0, static_cast<std::size_t>(width), big_endian_);
}

}  // namespace scotopic

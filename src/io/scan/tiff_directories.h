// Directories of a TIFF (revision 6.0, and BigTIFF), whether a file or a block in memory (Exif, MPF).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace scotopic {

/// As many of `count` bytes from `at` on as there are.
using ReadBytes = std::function<std::vector<std::byte>(std::uint64_t at, std::uint64_t count)>;

/// Of a block, which must outlive it.
ReadBytes bytes_in_memory(std::span<const std::byte> block);

class TiffDirectories {
 public:
  explicit TiffDirectories(ReadBytes read);

  struct Field {
    std::uint64_t tag = 0, type = 0, count = 0, at = 0;
  };

  /// Where the first directory is.
  std::uint64_t first() const { return first_; }
  bool big_endian() const { return big_endian_; }

  /// Fields of a directory; `next` becomes where the one after it is, or 0.
  std::vector<Field> fields(std::uint64_t directory, std::uint64_t& next) const;

  /// Bytes of a field's value, at most 64 MiB.
  std::vector<std::byte> bytes(const Field& field) const;

  /// Value `i` of a field of numbers; 0 for what is none.
  double value(const Field& field, std::size_t i = 0) const;
  /// The same as a whole number; 0 for what is beyond 2^53.
  std::int64_t integer(const Field& field, std::size_t i = 0) const;

 private:
  std::uint64_t number(std::uint64_t at, std::uint64_t width) const;

  ReadBytes read_;
  bool big_endian_ = false, big_ = false;
  std::uint64_t first_ = 0;
};

}  // namespace scotopic

// Any bytes of a file, by offset; reading beyond its end gives less.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace scotopic {

class FileBytes {
 public:
  /// Nothing is thrown for a file that cannot be read: it has no bytes then.
  explicit FileBytes(const std::string& file) : stream_(file, std::ios::binary) {
    stream_.seekg(0, std::ios::end);
    const std::streamoff end = stream_ ? std::streamoff{stream_.tellg()} : 0;
    size_ = end > 0 ? static_cast<std::uint64_t>(end) : 0;
  }

  std::uint64_t size() const noexcept { return size_; }

  /// As many of `count` bytes from `at` on as there are.
  std::vector<std::byte> at(std::uint64_t at, std::uint64_t count) {
    if (at >= size_) return {};
    std::vector<std::byte> out(static_cast<std::size_t>(std::min(count, size_ - at)));
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(at));
    stream_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
    out.resize(static_cast<std::size_t>(stream_.gcount()));
    return out;
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

/// An unsigned number of `width` bytes; 0 where it does not fit.
inline std::uint64_t number_at(const std::vector<std::byte>& bytes, std::size_t at, std::size_t width,
                               bool big_endian) {
  if (at > bytes.size() || width > bytes.size() - at) return 0;
  std::uint64_t out = 0;
  for (std::size_t i = 0; i < width; ++i)
    out = out << 8 | std::to_integer<std::uint64_t>(bytes[big_endian ? at + i : at + width - 1 - i]);
  return out;
}

}  // namespace scotopic

// The file layout is that of OpenEXR's own description, "OpenEXR File Layout" (openexr.com), version 2.
#include "io/exr/exr_headers.h"

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfLineOrder.h>
#include <OpenEXR/OpenEXRConfig.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "io/exr/exr_source.h"
#include "base/input_file.h"

namespace scotopic {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers in the file are little-endian");

constexpr std::uint32_t multi_part_flag = 0x1000;
constexpr std::size_t longest_name = 256;

/// The file from its start, in pieces.
class HeaderReader {
 public:
  HeaderReader(const std::string& file, std::int64_t size) : file_(file), size_(size) {
    descriptor_ = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(std::string("cannot be read: ") + std::strerror(errno));
  }
  ~HeaderReader() { close(descriptor_); }
  HeaderReader(const HeaderReader&) = delete;
  HeaderReader& operator=(const HeaderReader&) = delete;

  std::int64_t left() const { return size_ - at_; }
  std::int64_t size() const { return size_; }

  char next() {
    if (used_ == got_) refill();
    ++at_;
    return buffer_[used_++];
  }
  template <typename T>
  T number() {
    std::array<char, sizeof(T)> bytes;
    for (char& byte : bytes) byte = next();
    return std::bit_cast<T>(bytes);
  }
  std::string name() {
    std::string text;
    for (char c = next(); c != '\0'; c = next()) {
      if (text.size() == longest_name) fail("is not a valid OpenEXR file: a name without end in its header");
      text += c;
    }
    return text;
  }
  void skip(std::int64_t bytes) {
    const std::int64_t here = std::min<std::int64_t>(bytes, static_cast<std::int64_t>(got_ - used_));
    used_ += static_cast<std::size_t>(here);
    at_ += bytes;
    if (here != bytes) used_ = got_ = 0;
  }
  [[noreturn]] void fail(const std::string& what) const { throw Error(ExitCode::input, file_, what); }

 private:
  void refill() {
    ssize_t n = 0;
    do n = pread(descriptor_, buffer_.data(), buffer_.size(), at_);
    while (n < 0 && errno == EINTR);
    if (n < 0) fail(std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) fail("is truncated: it ends within its header");
    used_ = 0;
    got_ = static_cast<std::size_t>(n);
  }

  const std::string& file_;
  std::int64_t size_ = 0, at_ = 0;
  int descriptor_ = -1;
  std::array<char, 4096> buffer_;
  std::size_t used_ = 0, got_ = 0;
};

/// What sizes depend on.
struct PartSizes {
  std::int64_t width = 0, height = 0, channels = 0;
  std::int64_t tile_width = 0, tile_height = 0;  ///< 0: no tiles
  int compression = Imf::NO_COMPRESSION;
};

void read_window(HeaderReader& in, PartSizes& part) {
  const std::int64_t x0 = in.number<std::int32_t>(), y0 = in.number<std::int32_t>();
  const std::int64_t x1 = in.number<std::int32_t>(), y1 = in.number<std::int32_t>();
  part.width = x1 - x0 + 1;
  part.height = y1 - y0 + 1;
}

/// Each channel is its name, 0, and 16 bytes; an empty name ends the list.
void count_channels(HeaderReader& in, std::int64_t end, PartSizes& part) {
  while (in.left() > end && !in.name().empty()) {
    in.skip(16);
    ++part.channels;
  }
}

/// False at the end of the header.
bool read_attribute(HeaderReader& in, PartSizes& part) {
  const std::string name = in.name();
  if (name.empty()) return false;
  const std::string type = in.name();
  const std::int64_t size = in.number<std::int32_t>();
  if (size < 0 || size > in.left())
    in.fail(fmt::format("is truncated or damaged: attribute {} has {} bytes, the file {} more", name, size,
                        in.left()));
  const std::int64_t end = in.left() - size;
  if (name == "dataWindow" && type == "box2i" && size == 16) read_window(in, part);
  if (name == "channels" && type == "chlist") count_channels(in, end, part);
  if (name == "lineOrder" && size == 1 && static_cast<unsigned char>(in.next()) >= Imf::NUM_LINEORDERS)
    in.fail("is damaged: its rows are in an order that OpenEXR does not know");
  if (name == "chunkCount" && type == "int" && size == 4 && in.number<std::int32_t>() < 1)
    in.fail("is damaged: its header counts no chunks");
  if (name == "compression" && size == 1) part.compression = static_cast<unsigned char>(in.next());
  if (type == "preview" && size >= 8) {
    const std::int64_t width = in.number<std::uint32_t>(), height = in.number<std::uint32_t>();
    if (height > 0 && width > (size - 8) / 4 / height)
      in.fail("is damaged: its preview is larger than its header");
  }
  if (name == "tiles" && size == 9) {
    part.tile_width = in.number<std::uint32_t>();
    part.tile_height = in.number<std::uint32_t>();
  }
  if (in.left() < end) in.fail("is damaged: an attribute of its header is longer than it says");
  in.skip(in.left() - end);
  return true;
}

std::int64_t parts_of(std::int64_t whole, std::int64_t piece) { return (whole + piece - 1) / piece; }

/// Chunks that the file must at least list, 8 bytes each.
std::int64_t chunks_of(const PartSizes& part) {
  if (part.tile_width > 0 && part.tile_height > 0)
    return parts_of(part.width, part.tile_width) * parts_of(part.height, part.tile_height);
  return parts_of(part.height, rows_compressed_together(part.compression));
}

/// OpenEXR's own words for that are "invalid" and the like.
void check_compression(const PartSizes& part, HeaderReader& in) {
  if (part.compression < Imf::NUM_COMPRESSION_METHODS) return;
  const bool htj2k = part.compression == htj2k256 || part.compression == htj2k32;
  in.fail(fmt::format(
      "{}: OpenEXR {} here does not know {}",
      htj2k ? "was written by a newer OpenEXR" : "was written by a newer OpenEXR, or is damaged",
      OPENEXR_VERSION_STRING, htj2k ? "compression HTJ2K" : fmt::format("compression {}", part.compression)));
}

void check_part(const std::string& file, const PartSizes& part, const Limits& limits, HeaderReader& in,
                std::int64_t& chunks) {
  if (part.width <= 0 || part.height <= 0) return;  // OpenEXR refuses it
  check_limit(file, "side", std::max(part.width, part.height), limits.side, "--max-side");
  check_limit_product(file, "pixels", part.width, part.height, limits.pixels, "--max-pixels");
  check_limit(file, "channels", part.channels, limits.channels, "--max-channels");
  check_limit(file, "side of a tile", std::max(part.tile_width, part.tile_height), limits.side, "--max-side");
  check_compression(part, in);
  chunks += chunks_of(part);
  if (chunks > in.size() / 8)
    in.fail(fmt::format("is truncated: {} bytes do not hold the table of its {} chunks", in.size(), chunks));
}

/// The table behind the headers, or its first part: where chunks begin; 0: it is not written yet. Some
/// releases of OpenEXR make another table where this one is wrong.
void check_chunk_table(HeaderReader& in, std::int64_t chunks) {
  for (std::int64_t i = 0; i < chunks; ++i) {
    const auto offset = in.number<std::int64_t>();
    if (offset < 0 || offset >= in.size())
      in.fail(fmt::format("is truncated or damaged: chunk {} of its table lies beyond its end", i));
  }
}

}  // namespace

void check_exr_headers(const std::string& file, const Limits& limits) {
  const std::int64_t size = check_input_file(file, ExitCode::input, INT64_MAX, "");
  HeaderReader in(file, size);
  in.skip(4);
  const bool multi_part = (in.number<std::uint32_t>() & multi_part_flag) != 0;
  std::int64_t chunks = 0;
  for (bool more = true; more;) {
    PartSizes part;
    int attributes = 0;
    while (read_attribute(in, part)) ++attributes;
    // The headers of several parts end with an empty one.
    more = multi_part && attributes > 0;
    if (attributes > 0) check_part(file, part, limits, in, chunks);
  }
  check_chunk_table(in, chunks);
}

}  // namespace scotopic

// Chunks of a PNG (W3C PNG, third edition, 11.3).
#include <zlib.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "base/error.h"
#include "color/icc/icc_check.h"
#include "io/scan/file_bytes.h"
#include "io/scan/image_scan.h"

namespace scotopic {
namespace {

constexpr std::size_t signature_size = 8;
constexpr std::uint64_t most_chunk_bytes = std::uint64_t{64} << 20;  // of those that are looked into

using Bytes = std::vector<std::byte>;

/// zlib's stream, no longer than most_icc_bytes; as far as it goes.
Bytes inflated(std::span<const std::byte> packed) {
  Bytes out;
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return out;
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  Bytes piece(65536);
  for (int state = Z_OK; state == Z_OK && out.size() <= most_icc_bytes;) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = inflate(&stream, Z_NO_FLUSH);
    const std::size_t got = piece.size() - stream.avail_out;
    if (got == 0) break;
    out.insert(out.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got));
  }
  inflateEnd(&stream);
  return out;
}

/// Text up to a NUL; `at` is after it.
std::string_view text_at(std::span<const std::byte> chunk, std::size_t& at) {
  const std::string_view all(reinterpret_cast<const char*>(chunk.data()), chunk.size());
  const std::size_t from = std::min(at, all.size());
  const std::size_t end = std::min(all.find('\0', from), all.size());
  at = std::min(end + 1, all.size());
  return all.substr(from, end - from);
}

double fixed_point(const Bytes& chunk, std::size_t at) {
  return static_cast<double>(number_at(chunk, at, 4, true)) / 100000;
}

void read_chromaticities(const Bytes& chunk, ColourTags& tags) {
  const auto xy = [&](std::size_t i) { return Xy{fixed_point(chunk, 8 * i), fixed_point(chunk, 8 * i + 4)}; };
  tags.primaries = Primaries{xy(1), xy(2), xy(3), xy(0)};
}

void read_text(const std::string& type, const Bytes& chunk, const std::string& file, ImageScan& scan) {
  std::size_t at = 0;
  if (text_at(chunk, at) != "XML:com.adobe.xmp") return;
  bool packed = type == "zTXt";
  if (packed) ++at;
  if (type == "iTXt") {
    packed = number_at(chunk, at, 1, true) != 0;
    at += 2;
    text_at(chunk, at);
    text_at(chunk, at);
  }
  const auto rest = std::span(chunk).subspan(std::min(at, chunk.size()));
  if (packed)
    check_xmp(inflated(rest), file, scan);
  else
    check_xmp(rest, file, scan);
}

/// Pixels per unit, across and down: where they differ, pixels are no squares.
double phys_aspect(const Bytes& chunk) {
  const auto across = static_cast<double>(number_at(chunk, 0, 4, true));
  const auto down = static_cast<double>(number_at(chunk, 4, 4, true));
  return across > 0 && down > 0 ? down / across : 1.0;
}

/// One of a known size.
void read_fixed_chunk(const std::string& type, const Bytes& chunk, ImageScan& scan) {
  ColourTags& tags = scan.colour;
  const std::uint64_t first = number_at(chunk, 0, 4, true);
  if (type == "IHDR") {
    scan.width = static_cast<std::int64_t>(first);
    scan.height = static_cast<std::int64_t>(number_at(chunk, 4, 4, true));
  } else if (type == "cICP") {
    const auto code = [&](std::size_t i) { return std::to_integer<int>(chunk[i]); };
    tags.code_points = CodePoints{code(0), code(1), code(2), code(3) != 0};
  } else if (type == "gAMA" && first > 0) {
    tags.gamma = 1 / fixed_point(chunk, 0);
  } else if (type == "gAMA") {
    scan.notes.emplace_back("its chunk gAMA says nothing, and is left alone");
  } else if (type == "cHRM") {
    read_chromaticities(chunk, tags);
  } else if (type == "sRGB") {
    tags.srgb = true;
  } else if (type == "pHYs") {
    scan.pixel_aspect = phys_aspect(chunk);
  } else if (type == "acTL" && first > 1) {
    scan.notes.push_back("is an animation: one of its " + std::to_string(first) + " frames is read");
  }
}

struct Wanted {
  std::string_view type;
  std::size_t size;    // 0: any
  bool before_pixels;  // has no say behind them (11.3, table 7)
};
constexpr std::array<Wanted, 13> wanted = {{{"IHDR", 13, true},
                                            {"cICP", 4, true},
                                            {"gAMA", 4, true},
                                            {"cHRM", 32, true},
                                            {"sRGB", 1, true},
                                            {"pHYs", 9, true},
                                            {"acTL", 8, true},
                                            {"iCCP", 0, true},
                                            {"eXIf", 0, false},
                                            {"gmAP", 0, false},
                                            {"tEXt", 0, false},
                                            {"zTXt", 0, false},
                                            {"iTXt", 0, false}}};

void read_chunk(const Wanted& what, const Bytes& chunk, const std::string& file, ImageScan& scan) {
  const std::string type(what.type);
  if (what.size > 0 && chunk.size() != what.size) {
    scan.notes.push_back("its chunk " + type + " is not of its size, and is left alone");
  } else if (what.size > 0) {
    read_fixed_chunk(type, chunk, scan);
  } else if (type == "iCCP") {
    std::size_t at = 0;
    text_at(chunk, at);
    keep_profile(inflated(std::span(chunk).subspan(std::min(at + 1, chunk.size()))), file, scan);
  } else if (type == "gmAP") {  // of the fourth edition, whose gdAT follows it
    scan.gain_map = true;
  } else if (type == "eXIf") {
    read_exif(chunk, scan);
  } else {
    read_text(type, chunk, file, scan);
  }
}

/// Whether it counts where it stands: of those before the pixels the first.
bool counts(const Wanted& what, bool pixels_seen, std::set<std::string_view>& seen, ImageScan& scan) {
  if (!what.before_pixels) return true;
  const bool first = seen.insert(what.type).second;
  if (first && !pixels_seen) return true;
  scan.notes.push_back("its " + std::string(first ? "" : "second ") + "chunk " + std::string(what.type) +
                       (pixels_seen ? " stands behind the pixels and" : "") + " is left alone");
  return false;
}

}  // namespace

ImageScan scan_png(const std::string& file) {
  ImageScan scan;
  FileBytes bytes(file);
  bool pixels_seen = false;
  std::set<std::string_view> seen;
  for (std::uint64_t at = signature_size; at + 12 <= bytes.size();) {
    const Bytes head = bytes.at(at, 8);
    const std::uint64_t size = number_at(head, 0, 4, true);
    const std::string type(reinterpret_cast<const char*>(head.data()) + 4, 4);
    if (type == "IEND") break;
    pixels_seen = pixels_seen || type == "IDAT";
    const auto* const what =
        std::find_if(wanted.begin(), wanted.end(), [&](const Wanted& w) { return w.type == type; });
    if (what != wanted.end() && counts(*what, pixels_seen, seen, scan)) {
      if (size > most_chunk_bytes)
        throw Error(ExitCode::input, file, "is damaged: a chunk " + type + " is larger than any");
      read_chunk(*what, bytes.at(at + 8, size), file, scan);
    }
    at += size + 12;
  }
  return scan;
}

}  // namespace scotopic

// Directories of a TIFF (revision 6.0, and BigTIFF), and of Exif, which is one (CIPA DC-008, 4.6).
#include <algorithm>
#include <functional>
#include <optional>

#include "base/error.h"
#include "io/scan/file_bytes.h"
#include "io/scan/image_scan.h"

namespace scotopic {
namespace {

using Bytes = std::vector<std::byte>;
using Read = std::function<Bytes(std::uint64_t at, std::uint64_t count)>;

constexpr std::uint64_t most_entries = 4096, most_pages = 65536, most_value = std::uint64_t{64} << 20;

enum Tag : std::uint64_t {
  subfile_type = 254,
  bits_per_sample = 258,
  photometric = 262,
  orientation = 274,
  white_point = 318,
  primary_chromaticities = 319,
  sub_directories = 330,
  xmp = 700,
  exif_directory = 34665,
  icc_profile = 34675,
  exif_colour_space = 40961,
  interoperability_directory = 40965,
  interoperability_index = 1,
  multi_picture_entries = 0xb002,
  dng_version = 50706,
};

Read in_memory(std::span<const std::byte> block) {
  return [block](std::uint64_t at, std::uint64_t count) {
    if (at >= block.size()) return Bytes{};
    const auto piece = block.subspan(static_cast<std::size_t>(at));
    return Bytes(piece.begin(),
                 piece.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(count, piece.size())));
  };
}

/// Bytes of a value of each field type.
std::uint64_t size_of_type(std::uint64_t type) {
  static constexpr std::uint8_t sizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
  return type < std::size(sizes) ? sizes[type] : 0;
}

/// A TIFF, whether a file or a block in memory.
class Directories {
 public:
  explicit Directories(Read read) : read_(std::move(read)) {
    const Bytes head = read_(0, 16);
    big_endian_ = !head.empty() && head[0] == std::byte{'M'};
    big_ = number_at(head, 2, 2, big_endian_) == 43;
    first_ = big_ ? number_at(head, 8, 8, big_endian_) : number_at(head, 4, 4, big_endian_);
  }

  struct Field {
    std::uint64_t tag = 0, type = 0, count = 0, at = 0;
  };

  std::uint64_t first() const { return first_; }

  /// Fields of a directory; `next` becomes where the one after it is, or 0.
  std::vector<Field> fields(std::uint64_t directory, std::uint64_t& next) const {
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
    next = number_at(all, static_cast<std::size_t>(count * entry), static_cast<std::size_t>(offset),
                     big_endian_);
    return out;
  }

  Bytes bytes(const Field& field) const {
    return read_(field.at, std::min(std::min(field.count, most_value) *
                                        std::max<std::uint64_t>(1, size_of_type(field.type)),
                                    most_value));
  }

  /// Value `i` of an integer or rational field.
  double value(const Field& field, std::size_t i = 0) const {
    const std::uint64_t size = size_of_type(field.type);
    if (field.type == 5) return ratio(number(field.at + 8 * i, 4), number(field.at + 8 * i + 4, 4));
    return static_cast<double>(number(field.at + size * i, size));
  }

 private:
  static double ratio(std::uint64_t a, std::uint64_t b) {
    return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b);
  }
  std::uint64_t number(std::uint64_t at, std::uint64_t width) const {
    return number_at(read_(at, width), 0, static_cast<std::size_t>(width), big_endian_);
  }

  Read read_;
  bool big_endian_ = false, big_ = false;
  std::uint64_t first_ = 0;
};

void read_exif_directory(const Directories& tiff, std::uint64_t directory, ImageScan& scan) {
  std::uint64_t next = 0;
  bool uncalibrated = false;
  for (const Directories::Field& field : tiff.fields(directory, next)) {
    if (field.tag == exif_colour_space) {
      const auto value = static_cast<int>(tiff.value(field));
      uncalibrated = value == 0xffff;
      if (value == 1) scan.colour.exif = ExifColour::srgb;
      if (value == 2) scan.colour.exif = ExifColour::adobe_rgb;
    }
    if (field.tag == interoperability_directory)
      for (const Directories::Field& inner :
           tiff.fields(static_cast<std::uint64_t>(tiff.value(field)), next)) {
        const Bytes index = inner.tag == interoperability_index ? tiff.bytes(inner) : Bytes{};
        const bool r03 = index.size() >= 3 && index[0] == std::byte{'R'} && index[2] == std::byte{'3'};
        if (r03 && uncalibrated) scan.colour.exif = ExifColour::adobe_rgb;
      }
  }
}

void require_rgb(int value, const std::string& file) {
  const char* const what = value == 5                         ? "CMYK"
                           : value >= 8 && value <= 10        ? "CIE Lab"
                           : value == 32844 || value == 32845 ? "LogLuv"
                                                              : nullptr;
  if (what) throw Error(ExitCode::input, file, std::string("holds ") + what + ", not RGB: convert it first");
}

[[noreturn]] void fail_raw(const std::string& file) {
  throw Error(ExitCode::input, file, "is a camera's raw file: develop it first, to linear TIFF or OpenEXR");
}

/// A raw file is a TIFF whose first directory is a thumbnail, or a mosaic.
void refuse_raw(const Directories& tiff, const std::vector<Directories::Field>& fields,
                const std::string& file) {
  constexpr int mosaic = 32803, linear_raw = 34892, reduced = 1;
  bool raw = false, small = false, more = false;
  for (const Directories::Field& field : fields) {
    const bool number = field.tag == photometric || field.tag == subfile_type;
    const int value = number ? static_cast<int>(tiff.value(field)) : 0;
    raw = raw || field.tag == dng_version ||
          (field.tag == photometric && (value == mosaic || value == linear_raw));
    small = small || (field.tag == subfile_type && (value & reduced) != 0);
    more = more || field.tag == sub_directories;
  }
  if (raw || (small && more)) fail_raw(file);
}

/// OpenImageIO turns such values round where they are of 8 bits or less; of more it leaves them.
void refuse_white_zero(const Directories& tiff, const std::vector<Directories::Field>& fields,
                       const std::string& file) {
  bool white_zero = false, deep = false;
  for (const Directories::Field& field : fields) {
    if (field.tag == photometric) white_zero = tiff.value(field) == 0;
    if (field.tag == bits_per_sample) deep = tiff.value(field) > 8;
  }
  if (white_zero && deep)
    throw Error(ExitCode::input, file, "holds grey of more than 8 bits whose 0 is white: invert it first");
}

ImageScan scan_directory(const Directories& tiff, const std::vector<Directories::Field>& fields,
                         const std::string& file) {
  ImageScan scan;
  std::optional<Xy> white;
  std::optional<Primaries> primaries;
  for (const Directories::Field& field : fields) {
    const auto xy = [&](std::size_t i) { return Xy{tiff.value(field, 2 * i), tiff.value(field, 2 * i + 1)}; };
    if (field.tag == photometric) require_rgb(static_cast<int>(tiff.value(field)), file);
    if (field.tag == orientation) scan.orientation = static_cast<int>(tiff.value(field));
    if (field.tag == white_point && field.count == 2) white = xy(0);
    if (field.tag == primary_chromaticities && field.count == 6)
      primaries = Primaries{xy(0), xy(1), xy(2), {}};
    if (field.tag == xmp) check_xmp(tiff.bytes(field), file, scan);
    if (field.tag == icc_profile) keep_profile(tiff.bytes(field), file, scan);
    if (field.tag == exif_directory)
      read_exif_directory(tiff, static_cast<std::uint64_t>(tiff.value(field)), scan);
  }
  if (primaries && white) {
    primaries->white = *white;
    scan.colour.primaries = primaries;
  }
  return scan;
}

}  // namespace

std::vector<ImageScan> scan_tiff(const std::string& file) {
  FileBytes bytes(file);
  const Directories tiff([&](std::uint64_t at, std::uint64_t count) { return bytes.at(at, count); });
  constexpr std::uint64_t canon = 0x4352;  // "CR" of a CR2; no directory is that long
  if (number_at(bytes.at(8, 2), 0, 2, true) == canon) fail_raw(file);
  std::vector<ImageScan> pages;
  for (std::uint64_t at = tiff.first(), next = 0; at != 0 && pages.size() < most_pages; at = next) {
    const std::vector<Directories::Field> fields = tiff.fields(at, next);
    if (pages.empty()) refuse_raw(tiff, fields, file);
    refuse_white_zero(tiff, fields, file);
    pages.push_back(scan_directory(tiff, fields, file));
    if (next <= at && pages.size() > 1024) break;  // goes round
  }
  return pages;
}

std::vector<std::uint64_t> offsets_of_images(std::span<const std::byte> index) {
  constexpr std::size_t entry_bytes = 16, offset_at = 8;
  const Directories tiff(in_memory(index));
  const bool big_endian = !index.empty() && index[0] == std::byte{'M'};
  std::vector<std::uint64_t> out;
  std::uint64_t next = 0;
  for (const Directories::Field& field : tiff.fields(tiff.first(), next)) {
    const Bytes entries = field.tag == multi_picture_entries ? tiff.bytes(field) : Bytes{};
    for (std::size_t at = entry_bytes; at + entry_bytes <= entries.size(); at += entry_bytes)
      out.push_back(number_at(entries, at + offset_at, 4, big_endian));
  }
  return out;
}

void read_exif(std::span<const std::byte> block, ImageScan& scan) {
  const Directories tiff(in_memory(block));
  std::uint64_t next = 0;
  for (const Directories::Field& field : tiff.fields(tiff.first(), next)) {
    if (field.tag == orientation) scan.orientation = static_cast<int>(tiff.value(field));
    if (field.tag == exif_directory)
      read_exif_directory(tiff, static_cast<std::uint64_t>(tiff.value(field)), scan);
  }
}

}  // namespace scotopic

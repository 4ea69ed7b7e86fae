// Exif (CIPA DC-008, 4.6), which is a TIFF, and the index of a Multi-Picture Format (CIPA DC-007), another.
#include "io/scan/exif_scan.h"

#include <optional>
#include <string>

#include "io/scan/file_bytes.h"

namespace scotopic {
namespace {

using Bytes = std::vector<std::byte>;
using Field = TiffDirectories::Field;

enum ExifTag : std::uint64_t {
  orientation = 274,
  transfer_function = 301,
  white_point = 318,
  primary_chromaticities = 319,
  exif_directory = 34665,
  colour_space = 40961,
  interoperability_directory = 40965,
  gamma = 42240,
  interoperability_index = 1,
  multi_picture_entries = 0xb002,
};

constexpr std::int64_t uncalibrated = 0xffff;

/// DCF 2.0: R03 is its optional space, Adobe RGB.
bool has_index_r03(const TiffDirectories& tiff, std::uint64_t directory) {
  std::uint64_t next = 0;
  for (const Field& field : tiff.fields(directory, next)) {
    const Bytes index = field.tag == interoperability_index ? tiff.bytes(field) : Bytes{};
    if (index.size() >= 3 && index[0] == std::byte{'R'} && index[2] == std::byte{'3'}) return true;
  }
  return false;
}

void read_exif_directory(const TiffDirectories& tiff, std::uint64_t directory, ImageScan& scan) {
  std::uint64_t next = 0;
  std::int64_t space = 0;
  bool r03 = false;
  for (const Field& field : tiff.fields(directory, next)) {
    if (field.tag == colour_space) space = tiff.integer(field);
    if (field.tag == gamma) scan.colour.exif_gamma = tiff.value(field);
    if (field.tag == interoperability_directory)
      r03 = has_index_r03(tiff, static_cast<std::uint64_t>(tiff.integer(field)));
  }
  if (space == 1)
    scan.colour.exif = ExifColour::srgb;
  else if (space == 2 || (space == uncalibrated && r03))
    scan.colour.exif = ExifColour::adobe_rgb;
  else if (space != 0)
    scan.colour.exif = ExifColour::other;
}

/// One table for all channels, or three.
void read_table(const TiffDirectories& tiff, const Field& field, std::uint64_t bits, ImageScan& scan) {
  constexpr std::uint64_t shorts = 3;
  const std::uint64_t size = std::uint64_t{1} << bits;
  if (field.type != shorts || (field.count != size && field.count != 3 * size)) {
    scan.notes.emplace_back("its TransferFunction is not of its samples' bits, and is left alone");
    return;
  }
  const Bytes bytes = tiff.bytes(field);
  auto table = std::make_shared<std::vector<std::uint16_t>>();
  for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2)
    table->push_back(static_cast<std::uint16_t>(number_at(bytes, at, 2, tiff.big_endian())));
  if (table->size() == field.count) scan.colour.transfer_table = std::move(table);
}

}  // namespace

void read_colorimetry(const TiffDirectories& tiff, const std::vector<Field>& fields, std::uint64_t bits,
                      ImageScan& scan) {
  std::optional<Xy> white;
  std::optional<Primaries> primaries;
  for (const Field& field : fields) {
    const auto xy = [&](std::size_t i) { return Xy{tiff.value(field, 2 * i), tiff.value(field, 2 * i + 1)}; };
    if (field.tag == orientation) scan.orientation = static_cast<int>(tiff.integer(field) & 0xffff);
    if (field.tag == white_point && field.count == 2) white = xy(0);
    if (field.tag == primary_chromaticities && field.count == 6)
      primaries = Primaries{xy(0), xy(1), xy(2), white_d65};
    if (field.tag == transfer_function && bits <= 16) read_table(tiff, field, bits, scan);
    if (field.tag == exif_directory)
      read_exif_directory(tiff, static_cast<std::uint64_t>(tiff.integer(field)), scan);
  }
  if (!primaries) return;
  if (white) primaries->white = *white;
  if (!white) scan.notes.emplace_back("its primaries have no white beside them: D65 is assumed");
  scan.colour.primaries = primaries;
}

std::vector<std::uint64_t> offsets_of_images(std::span<const std::byte> index) {
  constexpr std::size_t entry_bytes = 16, offset_at = 8;
  const TiffDirectories tiff(bytes_in_memory(index));
  std::vector<std::uint64_t> out;
  std::uint64_t next = 0;
  for (const Field& field : tiff.fields(tiff.first(), next)) {
    const Bytes entries = field.tag == multi_picture_entries ? tiff.bytes(field) : Bytes{};
    for (std::size_t at = entry_bytes; at + entry_bytes <= entries.size(); at += entry_bytes)
      out.push_back(number_at(entries, at + offset_at, 4, tiff.big_endian()));
  }
  return out;
}

void read_exif(std::span<const std::byte> block, ImageScan& scan) {
  constexpr std::uint64_t bits_of_jpeg = 8;
  const TiffDirectories tiff(bytes_in_memory(block));
  std::uint64_t next = 0;
  read_colorimetry(tiff, tiff.fields(tiff.first(), next), bits_of_jpeg, scan);
}

}  // namespace scotopic

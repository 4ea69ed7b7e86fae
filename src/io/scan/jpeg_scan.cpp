// Marker segments of a JPEG (ITU-T T.81, annex B), and what applications put into them.
#include <algorithm>
#include <map>
#include <string_view>

#include "base/error.h"
#include "io/scan/file_bytes.h"
#include "io/scan/image_scan.h"

namespace scotopic {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint64_t app0 = 0xe0, app1 = 0xe1, app2 = 0xe2;
constexpr int most_images = 64;  // of a Multi-Picture Format, that are looked into

bool begins(const Bytes& segment, std::string_view with) {
  return segment.size() >= with.size() &&
         std::equal(with.begin(), with.end(), segment.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

std::span<const std::byte> after(const Bytes& segment, std::string_view head) {
  return std::span(segment).subspan(head.size());
}

using namespace std::string_view_literals;

constexpr std::string_view jfif_head = "JFIF\0"sv, exif_head = "Exif\0\0"sv,
                           xmp_head = "http://ns.adobe.com/xap/1.0/\0"sv, icc_head = "ICC_PROFILE\0"sv,
                           gain_map_head = "urn:iso:std:iso:ts:21496:-1\0"sv, multi_picture_head = "MPF\0"sv;

/// Frame headers: all SOF but those of tables (DHT, JPG, DAC).
bool is_frame(std::uint64_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Profiles come in numbered pieces (ICC.1, B.4).
Bytes joined(const std::map<std::uint64_t, Bytes>& pieces) {
  Bytes out;
  for (const auto& [number, piece] : pieces) out.insert(out.end(), piece.begin(), piece.end());
  return out;
}

/// Marker segments from `at`, where SOI is, to the first scan.
template <typename Use>
void each_segment(FileBytes& bytes, std::uint64_t at, Use use) {
  for (at += 2; at + 4 <= bytes.size();) {
    const Bytes head = bytes.at(at, 4);
    const std::uint64_t marker = number_at(head, 1, 1, true), size = number_at(head, 2, 2, true);
    if (head[0] != std::byte{0xff} || marker == 0xda || marker == 0xd9) break;
    if (marker == 0xff || marker == 0x01 ||
        (marker >= 0xd0 && marker <= 0xd8)) {  // fill bytes, and markers alone
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (size < 2) break;
    const bool wanted = marker == app0 || marker == app1 || marker == app2 || is_frame(marker);
    use(marker, at + 4, wanted ? bytes.at(at + 4, size - 2) : Bytes{});
    at += 2 + size;
  }
}

/// Whether one image of a Multi-Picture Format says that it is a gain map, or has one.
bool tells_of_gain_map(FileBytes& bytes, std::uint64_t start, const std::string& file) {
  ImageScan scan;
  each_segment(bytes, start, [&](std::uint64_t marker, std::uint64_t, const Bytes& segment) {
    if (marker == app1 && begins(segment, xmp_head)) check_xmp(after(segment, xmp_head), file, scan);
    if (marker == app2 && begins(segment, gain_map_head)) scan.gain_map = true;
  });
  return scan.gain_map;
}

/// Images behind the first (CIPA DC-007); their offsets count from behind the identifier.
void scan_multi_picture(FileBytes& bytes, const Bytes& segment, std::uint64_t at, const std::string& file,
                        ImageScan& scan) {
  for (const std::uint64_t offset : offsets_of_images(after(segment, multi_picture_head))) {
    if (++scan.images_behind > most_images) break;
    if (tells_of_gain_map(bytes, at + multi_picture_head.size() + offset, file)) scan.gain_map = true;
  }
}

/// JFIF 1.02: version, units, and how many pixels there are to one, across and down.
double density_aspect(const Bytes& segment) {
  const auto across = static_cast<double>(number_at(segment, jfif_head.size() + 3, 2, true));
  const auto down = static_cast<double>(number_at(segment, jfif_head.size() + 5, 2, true));
  return across > 0 && down > 0 ? down / across : 1.0;
}

}  // namespace

ImageScan scan_jpeg(const std::string& file) {
  ImageScan scan;
  FileBytes bytes(file);
  std::map<std::uint64_t, Bytes> profile;
  each_segment(bytes, 0, [&](std::uint64_t marker, std::uint64_t at, const Bytes& segment) {
    if (is_frame(marker) && number_at(segment, 5, 1, true) == 4)
      throw Error(ExitCode::input, file, "holds CMYK, not RGB: convert it first, with its profile");
    if (marker == app0 && begins(segment, jfif_head)) scan.pixel_aspect = density_aspect(segment);
    if (marker == app1 && begins(segment, exif_head)) read_exif(after(segment, exif_head), scan);
    if (marker == app1 && begins(segment, xmp_head)) check_xmp(after(segment, xmp_head), file, scan);
    if (marker == app2 && begins(segment, gain_map_head)) scan.gain_map = true;
    if (marker == app2 && begins(segment, multi_picture_head))
      scan_multi_picture(bytes, segment, at, file, scan);
    if (marker == app2 && begins(segment, icc_head) && segment.size() >= icc_head.size() + 2)
      profile.emplace(number_at(segment, icc_head.size(), 1, true),
                      Bytes(segment.begin() + icc_head.size() + 2, segment.end()));
  });
  if (!profile.empty()) keep_profile(joined(profile), file, scan);
  return scan;
}

}  // namespace scotopic

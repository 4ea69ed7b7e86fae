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

constexpr std::uint64_t app1 = 0xe1, app2 = 0xe2;

bool begins(const Bytes& segment, std::string_view with) {
  return segment.size() >= with.size() &&
         std::equal(with.begin(), with.end(), segment.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

std::span<const std::byte> after(const Bytes& segment, std::string_view head) {
  return std::span(segment).subspan(head.size());
}

using namespace std::string_view_literals;

constexpr std::string_view exif = "Exif\0\0"sv, xmp = "http://ns.adobe.com/xap/1.0/\0"sv,
                           icc = "ICC_PROFILE\0"sv, gain_map = "urn:iso:std:iso:ts:21496:-1\0"sv;

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

}  // namespace

ImageScan scan_jpeg(const std::string& file) {
  ImageScan scan;
  FileBytes bytes(file);
  std::map<std::uint64_t, Bytes> profile;
  for (std::uint64_t at = 2; at + 4 <= bytes.size();) {
    const Bytes head = bytes.at(at, 4);
    const std::uint64_t marker = number_at(head, 1, 1, true), size = number_at(head, 2, 2, true);
    if (head[0] != std::byte{0xff} || marker == 0xda || marker == 0xd9) break;
    if (marker == 0xff || marker == 0x01 ||
        (marker >= 0xd0 && marker <= 0xd8)) {  // fill bytes, and markers alone
      at += marker == 0xff ? 1 : 2;
      continue;
    }
    if (size < 2) break;
    const Bytes segment =
        marker == app1 || marker == app2 || is_frame(marker) ? bytes.at(at + 4, size - 2) : Bytes{};
    if (is_frame(marker) && number_at(segment, 5, 1, true) == 4)
      throw Error(ExitCode::input, file, "holds CMYK, not RGB: convert it first, with its profile");
    if (marker == app1 && begins(segment, exif)) read_exif(after(segment, exif), scan);
    if (marker == app1 && begins(segment, xmp)) check_xmp(after(segment, xmp), file, scan);
    if (marker == app2 && begins(segment, gain_map)) scan.gain_map = true;
    if (marker == app2 && begins(segment, icc) && segment.size() >= icc.size() + 2)
      profile.emplace(number_at(segment, icc.size(), 1, true),
                      Bytes(segment.begin() + icc.size() + 2, segment.end()));
    at += 2 + size;
  }
  if (!profile.empty()) keep_profile(joined(profile), file, scan);
  return scan;
}

}  // namespace scotopic

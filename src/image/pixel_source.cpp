#include "image/pixel_source.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "image/error.h"

namespace scotopic {
namespace {

using namespace std::string_view_literals;

/// The first bytes that each format we test begins with.
struct Magic {
  std::string_view bytes;
  const char* format;
};
constexpr std::array<Magic, 9> magics = {{{"\x76\x2f\x31\x01"sv, "openexr"},
                                          {"\x89PNG\r\n\x1a\n"sv, "png"},
                                          {"\xff\xd8\xff"sv, "jpeg"},
                                          {"II*\0"sv, "tiff"},
                                          {"MM\0*"sv, "tiff"},
                                          {"II+\0"sv, "tiff"},
                                          {"MM\0+"sv, "tiff"},
                                          {"#?RADIANCE"sv, "hdr"},
                                          {"#?RGBE"sv, "hdr"}}};

std::string format_of(const std::string& file) {
  struct stat info = {};
  if (stat(file.c_str(), &info) != 0) throw Error(ExitCode::input, file, std::strerror(errno));
  if (S_ISDIR(info.st_mode)) throw Error(ExitCode::input, file, "is a folder, not an image");
  if (!S_ISREG(info.st_mode)) throw Error(ExitCode::input, file, "is not a regular file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(ExitCode::input, file, std::string("cannot be read: ") + std::strerror(errno));
  std::array<char, 16> start{};
  stream.read(start.data(), start.size());
  const std::string_view head(start.data(), static_cast<std::size_t>(stream.gcount()));
  for (const Magic& magic : magics)
    if (head.substr(0, magic.bytes.size()) == magic.bytes) return magic.format;
  throw Error(ExitCode::input, file,
              head.empty() ? "is empty" : "is not an image (of OpenEXR, TIFF, PNG, JPEG, HDR)");
}

std::string exceeds(const char* what, std::int64_t value, std::int64_t limit, const char* flag) {
  return std::string(what) + " " + std::to_string(value) + " exceeds the limit of " + std::to_string(limit) +
         " (raise it with " + flag + ")";
}

}  // namespace

void PixelSource::fail(const std::string& what) const {
  std::string line = what;
  std::replace(line.begin(), line.end(), '\n', ' ');
  throw Error(ExitCode::input, file_, line);
}

void PixelSource::check_limits(const Limits& limits) const {
  const auto check = [&](const char* what, std::int64_t value, std::int64_t limit, const char* flag) {
    if (value > limit) throw Error(ExitCode::limit, file_, exceeds(what, value, limit, flag));
  };
  for (const Picture& picture : pictures_) {
    const std::int64_t width = std::int64_t{picture.data.x1} - picture.data.x0;
    const std::int64_t height = std::int64_t{picture.data.y1} - picture.data.y0;
    if (width <= 0 || height <= 0) fail("has no pixels");
    check("side", std::max(width, height), limits.side, "--max-side");
    check("pixels", width * height, limits.pixels, "--max-pixels");
    check("channels", static_cast<std::int64_t>(picture.channels.size()), limits.channels, "--max-channels");
    std::int64_t pixel = 0;
    for (const Channel& channel : picture.channels) pixel += static_cast<std::int64_t>(size_of(channel.type));
    const std::int64_t rows = std::min<std::int64_t>(picture.chunk_rows, height);
    check("bytes of one band", pixel * width * rows, limits.band_bytes, "--max-band-bytes");
  }
}

std::unique_ptr<PixelSource> open_source(const std::string& file, const Limits& limits) {
  const std::string format = format_of(file);
  return format == "openexr" ? open_exr_source(file, limits) : open_oiio_source(file, format, limits);
}

}  // namespace scotopic

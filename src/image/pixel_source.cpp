#include "image/pixel_source.h"

#include <algorithm>

#include "image/error.h"

namespace scotopic {
namespace {

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

}  // namespace scotopic

#include "io/pixel_source.h"

#include <algorithm>

#include "base/error.h"

namespace scotopic {

void PixelSource::fail(const std::string& what) const {
  std::string line = what;
  std::replace(line.begin(), line.end(), '\n', ' ');
  throw Error(ExitCode::input, file_, line);
}

void PixelSource::check_limits(const Limits& limits) const {
  for (const Subimage& subimage : subimages_) {
    const std::int64_t width = std::int64_t{subimage.data.x1} - subimage.data.x0;
    const std::int64_t height = std::int64_t{subimage.data.y1} - subimage.data.y0;
    if (width <= 0 || height <= 0) fail("has no pixels");
    check_limit(file_, "side", std::max(width, height), limits.side, "--max-side");
    check_limit_product(file_, "pixels", width, height, limits.pixels, "--max-pixels");
    check_limit(file_, "channels", static_cast<std::int64_t>(subimage.channels.size()), limits.channels,
                "--max-channels");
    check_limit(file_, "bytes of memory planned", planned_bytes(subimage), limits.memory, "--max-memory");
  }
}

void PixelSource::require_unchanged() const {
  for (const FileState& file : watched_) file.require_unchanged();
}

}  // namespace scotopic

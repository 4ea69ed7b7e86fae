#include "io/oiio/oriented_page.h"

#include <array>
#include <cstring>

namespace scotopic {

void copy_upright(const StoredPage& page, int orientation, std::size_t y0, std::size_t rows, std::byte* out) {
  const std::size_t w = page.width, h = page.height;
  const std::size_t width = turns(orientation) ? h : w;
  // Where the stored row and column run against the upright ones.
  const bool flip_x = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool flip_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  for (std::size_t y = y0; y < y0 + rows; ++y)
    for (std::size_t x = 0; x < width; ++x, out += page.pixel) {
      std::size_t sx = turns(orientation) ? y : x, sy = turns(orientation) ? x : y;
      if (flip_x) sx = w - 1 - sx;
      if (flip_y) sy = h - 1 - sy;
      std::memcpy(out, page.bytes.data() + (sy * w + sx) * page.pixel, page.pixel);
    }
}

const char* orientation_words(int orientation) {
  static constexpr std::array words = {"",
                                       "",
                                       "mirrored",
                                       "turned by 180 degrees",
                                       "flipped upside down",
                                       "transposed",
                                       "turned by 90 degrees clockwise",
                                       "transposed along the other diagonal",
                                       "turned by 90 degrees counter-clockwise"};
  return orientation >= 1 && orientation <= 8 ? words[static_cast<std::size_t>(orientation)] : "";
}

}  // namespace scotopic

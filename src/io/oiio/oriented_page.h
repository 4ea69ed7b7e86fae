// A page as it is to be looked at: Exif's orientation applied.
#pragma once

#include <cstddef>
#include <vector>

namespace scotopic {

/// Width and height change places.
constexpr bool turns(int orientation) { return orientation >= 5; }

/// A page as it is stored: `height` rows of `width` pixels of `pixel` bytes.
struct StoredPage {
  std::vector<std::byte> bytes;
  std::size_t width = 0, height = 0, pixel = 0;
};

/// Rows y0 <= y < y0 + rows of the upright subimage; orientation 1 to 8 (CIPA DC-008, 4.6.5).
void copy_upright(const StoredPage& page, int orientation, std::size_t y0, std::size_t rows, std::byte* out);

/// "mirrored", "turned by 180 degrees", ...: what was done to make it upright.
const char* orientation_words(int orientation);

}  // namespace scotopic

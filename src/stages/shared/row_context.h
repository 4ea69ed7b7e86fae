// Where a row of pixels lies, in its picture and in time: what a stage is told whose result depends on it.
#pragma once

#include <cstdint>

namespace scotopic {

/// When a picture is seen, and which sequence of random numbers belongs to it.
struct Moment {
  int frame = 0;       ///< its number in a sequence; 0 for a picture by itself
  double seconds = 0;  ///< since frame 0
  std::uint64_t seed = 0;
};

/// A row of pixels, or a piece of one. Coordinates are the file's: of its data and display windows.
struct RowContext {
  int x = 0;  ///< of the first pixel
  int y = 0;
  int display_x0 = 0, display_y0 = 0, display_x1 = 0, display_y1 = 0;  ///< display window: x0 <= x < x1
  Moment moment;
};

}  // namespace scotopic

// Which samples of which level of the pyramid a rectangle of the picture needs, along one axis.
#pragma once

#include <vector>

namespace scotopic::contrast {

/// Samples begin ... end - 1.
struct Range {
  int begin = 0, end = 0;
  int size() const noexcept { return end - begin; }
};

/// Samples on each side of the middle that the local contrast of a band is taken over: 3 sigma, of 2 samples.
inline constexpr int blur_reach = 6;

/// Sample i of level k + 1 lies on sample 2 i of level k; level 0 is the picture, from its first pixel on. So
/// a level's samples are the same for any window or tile.
struct AxisRanges {
  std::vector<int> size;      ///< of each level, the picture's first; one more than there are bands
  std::vector<Range> source;  ///< of each level: where light must be known
  std::vector<Range> band;    ///< of each band: where the difference of two levels is taken
  std::vector<Range> change;  ///< of each level: where the change is computed; the first holds the tile
};

/// What pixels `tile` of an axis of `length` pixels need with `bands` bands.
AxisRanges axis_ranges(Range tile, int length, int bands);

/// Pixels that `bands` bands need around any tile of any picture.
int pyramid_halo(int bands);

}  // namespace scotopic::contrast

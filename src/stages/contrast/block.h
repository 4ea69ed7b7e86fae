// The pyramid over a rectangle of a picture, taken apart, faded and put together; for the files of this room.
#pragma once

#include <cstddef>
#include <vector>

#include "stages/acuity/filter.h"
#include "stages/contrast/plane.h"
#include "stages/contrast/ranges.h"
#include "stages/contrast/rows.h"

namespace scotopic::contrast {

/// What a filter knows before it sees a picture.
struct Constants {
  LightWeights weights{};
  std::vector<ExcessTable> bands;  ///< finest first
  Applied applied;
};

/// Memory and method for one rectangle after the other.
class Block {
 public:
  explicit Block(const Constants& constants) : constants_(constants), levels_(constants.bands.size() + 1) {}

  /// Computes `tile` from `window`, which holds what axis_ranges asks for.
  void filter(const AcuityWindow& window, const AcuityTile& tile);

 private:
  struct Level {
    Plane log;      ///< of luminance, log2 relative to the adaptation luminance
    Plane light;    ///< luminance; from level 1 on, when all levels are built, its log2
    Plane present;  ///< 1 or 0
    Plane band;     ///< log less that of the next coarser level
    Plane squares;  ///< of band, blurred along rows
    Plane change;   ///< of log
  };

  void read(const AcuityWindow& window);
  void build(std::size_t k);
  void take_band(std::size_t k);
  void fade(std::size_t k);
  void write(const AcuityWindow& window, const AcuityTile& tile) const;
  /// What of a level is there; null where all is.
  const Plane* present(std::size_t k) const { return all_present_ ? nullptr : &levels_[k].present; }

  const Constants& constants_;
  AxisRanges x_, y_;
  std::vector<Level> levels_;
  bool all_present_ = true;
};

}  // namespace scotopic::contrast

// The glare function as Gaussians on the levels of a pyramid: sizes, taps and weights, all before any pixel
// is seen.
#pragma once

#include <cstddef>
#include <vector>

#include "stages/glare/psf.h"
#include "stages/glare/pyramid/wrapped.h"

namespace scotopic {

/// Whether a picture ends at its sides or is a panorama of 360 degrees, whose left side is right of its right
/// one.
enum class GlareSides { end, meet };

/// What is convolved.
struct GlareGrid {
  int width = 0, height = 0;
  /// Pixels per degree along each axis, > 0; one is at most twice the other.
  double ppd_x = 0, ppd_y = 0;
  GlareSides sides = GlareSides::end;
  /// All weights are multiplied by it, 0 ... 1.
  double strength = 1;
};

namespace glare {

/// Samples that every level keeps beyond the picture, zero further out: without them rims err by 80 %.
inline constexpr int margin = 3;

/// Weights of a symmetric filter: half[0] is the middle's, half[d] that of both samples d away.
using HalfTaps = std::vector<float>;

/// A Gaussian as rows and columns; the weight of the rung is in x.
struct Rung {
  HalfTaps x, y;
};

/// A level: every second sample of the one below, of every second row; of a panorama see wrapped.h.
struct Level {
  int width, height;
  int x_begin, x_end, y_begin, y_end;  ///< the picture's samples and the margin
  double across = 1, down = 1;         ///< pixels from sample to sample
  double blur_x = 0, blur_y = 0;       ///< squared sigma, pixels, of the ways up to this level and down again
  std::vector<Wrapped> wrapped = {};   ///< how rows of a panorama are halved whose width is odd
  std::vector<Rung> rungs = {};        ///< widest first
  int reach() const { return static_cast<int>(rungs.front().y.size()) - 1; }
};

/// Neighbours in a row of a ring, `dy` rows below and from `dx` samples to the right on.
struct Arc {
  int dy, dx;
  std::vector<float> weights;
};

/// A ring one sample thin, row by row downwards.
struct Ring {
  std::vector<Arc> arcs;
};

/// The lens's halo: what of a level is blurred by `spread`, and sent to a ring for each plane of light.
struct Halo {
  int level = 0;  ///< 0: there is none
  int reach = 0;  ///< of the widest ring along a row
  int wide = 0;   ///< reach of `spread`
  Rung spread;
  std::vector<Ring> rings;
};

/// For a function with a halo, of a picture whose levels are made. Each ring's weights sum to the halo's
/// share.
Halo halo_of(const GlareFunction& function, const GlareGrid& grid, const std::vector<Level>& levels);

/// Levels 0 ... L-1 add their rungs; of the last, L, every pair of samples is summed directly.
struct Ladder {
  /// Throws std::invalid_argument for a grid outside its domain.
  Ladder(const GlareFunction& function, const GlareGrid& grid);

  std::vector<Level> levels;  ///< the last has no rungs
  GlareSides sides;
  /// Weight in the last level of a sample (dx, dy) away: top[dy * top_width + dx].
  std::vector<float> top;
  int top_width;
  Halo halo;
  /// Sum of all weights over an endless plane, at most: how much light can leave a pixel.
  double most;
};

}  // namespace glare
}  // namespace scotopic

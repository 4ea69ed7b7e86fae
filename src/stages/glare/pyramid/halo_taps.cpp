// The lens's halo as taps.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "stages/glare/halo.h"
#include "stages/glare/pyramid/ladder.h"
#include "stages/glare/pyramid/taps.h"

namespace scotopic::glare {
namespace {

// The level is the coarsest on which the halo's Gaussian is so wide, in samples: what is then left of it
// beside the pyramid's own blur is wide enough to be sampled.
constexpr double least_sigma = 1.7;
// A ring's points fall on the four samples around each by a hat along each axis; its squared sigma, samples.
constexpr double hat = 1.0 / 6;
constexpr int points_of_sample = 16;
// Where not even level 1 is fine enough, the halo is drawn wider than it is.
constexpr double least_spread = 0.5;

int level_of(const GlareGrid& grid, int last) {
  const double samples = halo_sigma * std::min(grid.ppd_x, grid.ppd_y);
  return std::clamp(static_cast<int>(std::floor(std::log2(samples / least_sigma))), 1, last);
}

/// Along an axis of which a sample is `pitch` degrees and `pixels` pixels; `blur` is the pyramid's own.
double spread_of(double pitch, double pixels, double blur) {
  const double left = squared(halo_sigma / pitch) - blur / squared(pixels) - hat;
  return std::sqrt(std::max(left, squared(least_spread)));
}

/// A level's samples in degrees.
struct Pitch {
  double x, y;
};

/// A quarter of a ring of weight 1, to the right and below.
class Quarter {
 public:
  Quarter(const Pitch& pitch, double wavelength);
  /// Of the whole ring, a sample (dx, dy) away.
  double weight(int dx, int dy) const {
    const double on_axis = (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1);
    return on_axis * at_[static_cast<std::size_t>(std::abs(dy) * columns_ + std::abs(dx))];
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  void add(double x, double y, double weight);

  int columns_, rows_;
  std::vector<double> at_;
};

Quarter::Quarter(const Pitch& pitch, double wavelength) {
  // A Gaussian blurs a ring towards its middle.
  const double radius = halo_radius(wavelength) + squared(halo_sigma) / (2 * halo_radius(wavelength));
  columns_ = static_cast<int>(radius / pitch.x) + 2;
  rows_ = static_cast<int>(radius / pitch.y) + 2;
  at_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const int points = points_of_sample * std::max(columns_, rows_);
  for (int i = 0; i < points; ++i) {
    const double angle = (i + 0.5) / points * std::numbers::pi / 2;
    add(radius * std::cos(angle) / pitch.x, radius * std::sin(angle) / pitch.y, 0.25 / points);
  }
}

void Quarter::add(double x, double y, double weight) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      at_[static_cast<std::size_t>((y0 + j) * columns_ + x0 + i)] +=
          weight * (1 - std::abs(x - x0 - i)) * (1 - std::abs(y - y0 - j));
}

/// `quarter` times `share`; cut to samples that a picture so wide and high has for some sample of it.
Ring ring_of(const Quarter& quarter, double share, int width, int height) {
  Ring out;
  const int most_dx = std::min(quarter.columns(), width) - 1, most_dy = std::min(quarter.rows(), height) - 1;
  for (int dy = -most_dy; dy <= most_dy; ++dy) {
    bool open = false;
    for (int dx = -most_dx; dx <= most_dx; ++dx) {
      const double w = quarter.weight(dx, dy);
      if (w > 0 && !open) out.arcs.push_back({dy, dx, {}});
      open = w > 0;
      if (open) out.arcs.back().weights.push_back(static_cast<float>(share * w));
    }
  }
  return out;
}

int ring_reach(const Ring& ring) {
  int out = 0;
  for (const Arc& arc : ring.arcs) out = std::max(out, std::abs(arc.dx));
  return out;
}

}  // namespace

Halo halo_of(const GlareFunction& function, const GlareGrid& grid, const std::vector<Level>& levels) {
  Halo out;
  if (function.halo() == 0) return out;
  out.level = level_of(grid, static_cast<int>(levels.size()) - 1);
  const Level& level = levels[static_cast<std::size_t>(out.level)];
  const Pitch pitch = {level.across / grid.ppd_x, level.down / grid.ppd_y};
  out.spread = {scaled(sampled_taps(spread_of(pitch.x, level.across, level.blur_x)), 1),
                scaled(sampled_taps(spread_of(pitch.y, level.down, level.blur_y)), 1)};
  out.wide = std::max(static_cast<int>(out.spread.x.size()), static_cast<int>(out.spread.y.size())) - 1;
  for (const double wavelength : halo_wavelengths) {
    out.rings.push_back(ring_of(Quarter(pitch, wavelength), grid.strength * function.halo(),
                                level.x_end - level.x_begin + 2 * out.wide,
                                level.y_end - level.y_begin + 2 * out.wide));
    out.reach = std::max(out.reach, ring_reach(out.rings.back()));
  }
  return out;
}

}  // namespace scotopic::glare

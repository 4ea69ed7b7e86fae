// Loss of detail in dim light: a bilateral filter (Tomasi and Manduchi 1998), Gaussian in space and in the
// CIELAB distance. Fine texture goes, edges stay. Knows planes of pixels, nothing of files.
#pragma once

#include <cstddef>
#include <memory>

#include "kernel/matrix3.h"
#include "stages/shared/parallel_for.h"

namespace scotopic {

/// What is averaged, always under weights from the CIELAB distance: linear light (what optics and pooling in
/// the retina add up; keeps the mean luminance), or the CIELAB values themselves (Tomasi and Manduchi).
enum class AcuitySpace { light, lab };

/// `window` visits every pixel under the Gaussian: exact, and its cost grows with the square of sigma.
/// `cells` replaces the pixels of small squares by a few Gaussian clusters, and those around a block of
/// pixels by the block's palette: flat cost, approximate.
enum class AcuityEngine { automatic, window, cells };

/// How far the Gaussian reaches and how finely cells are divided. Error bounds: docs/acuity.md.
enum class AcuityQuality { draft, normal, fine };

/// What the filter is told; everything has its domain.
struct AcuityParameters {
  /// Standard deviation in space, pixels; >= 0 and finite. 0 (or too small to reach a neighbour): identity.
  double sigma = 0.0;
  /// Width over height of a pixel, 0.1 to 10: sigma counts pixels across, sigma times this pixels down. The
  /// cells engine takes pixels for square: other than 1 only `window` will do, and automatic is that.
  double pixel_aspect = 1.0;
  /// Standard deviation in CIELAB units; > 0 and finite.
  double range_sigma = 15.0;
  /// Luminance, in units of the image, of the white that CIELAB is relative to: La/0.18/white_luminance.
  double white = 1.0;
  /// CIE XYZ (D65 white, Y = 1 for RGB 1,1,1) from the linear RGB of the planes; invertible.
  Matrix3<double> xyz_from_rgb = identity3<double>();
  /// 0: identity; 1: the filter; between: a mixture of the two in linear light.
  double strength = 1.0;
  AcuitySpace space = AcuitySpace::light;
  AcuityEngine engine = AcuityEngine::automatic;
  AcuityQuality quality = AcuityQuality::normal;
};

/// Linear RGB planes of a rectangle of an image of image_width x image_height pixels. (x, y) is where the
/// rectangle's first pixel lies in the image; `stride` is in floats from row to row.
struct AcuityWindow {
  const float* r = nullptr;
  const float* g = nullptr;
  const float* b = nullptr;
  std::ptrdiff_t stride = 0;
  int x = 0, y = 0, width = 0, height = 0;
  int image_width = 0, image_height = 0;
};

/// The rectangle to be computed, in the same coordinates. Must not overlap the window in memory.
struct AcuityTile {
  float* r = nullptr;
  float* g = nullptr;
  float* b = nullptr;
  std::ptrdiff_t stride = 0;
  int x = 0, y = 0, width = 0, height = 0;
};

/// The identity: the tile's pixels of the window, which must hold it.
void copy_tile(const AcuityWindow& window, const AcuityTile& tile) noexcept;

/// A filter of an image's light that looks at the pixels around each. Immutable: share it between threads.
class SpatialFilter {
 public:
  virtual ~SpatialFilter() = default;

  /// Pixels around a tile that its window must hold, as far as the image goes; 0 where the filter is the
  /// identity.
  virtual int halo() const noexcept = 0;

  /// Computes `tile` from `window`. The result of a pixel depends on the image alone: not on tile, window or
  /// threads. Throws std::invalid_argument where the window does not hold the tile and its halo.
  virtual void filter(const AcuityWindow& window, const AcuityTile& tile,
                      const ParallelFor& parallel_for = serial_for) const = 0;

 protected:
  SpatialFilter() = default;
  /// Filters move; what is moved from can only be destroyed.
  SpatialFilter(SpatialFilter&&) = default;
  /// See above.
  SpatialFilter& operator=(SpatialFilter&&) = default;
};

/// The filter with all that does not depend on the image worked out. Immutable: share it between threads.
///
/// A pixel with a non-finite component, or beyond 1e5 CIELAB units from black (light over 6e8 times the
/// white), passes unchanged and is seen by no other pixel. Pixels outside the image do not exist: nothing is
/// mirrored or padded, and a constant image comes back bit for bit.
class AcuityFilter : public SpatialFilter {
 public:
  /// Throws std::invalid_argument where a parameter is outside its stated domain.
  explicit AcuityFilter(const AcuityParameters& parameters);
  ~AcuityFilter() override;
  /// What is moved from can only be destroyed.
  AcuityFilter(AcuityFilter&&) noexcept;
  /// See above.
  AcuityFilter& operator=(AcuityFilter&&) noexcept;

  int halo() const noexcept override;

  /// The engine in use: window or cells.
  AcuityEngine engine() const noexcept;

  /// Scratch memory: for the window engine (256 rows + 2 halo) x window.width x 24 bytes; for cells, over as
  /// many rows, 90 bytes for each cluster: one or two a cell of half a sigma, in noise one for each pixel, 64
  /// at most.
  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for = serial_for) const override;

 private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

}  // namespace scotopic

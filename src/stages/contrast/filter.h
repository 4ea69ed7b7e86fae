// Loss of contrast in dim light: each band of spatial frequencies keeps what stands as far above the
// dark-adapted eye's threshold as it will stand above that of the display's viewer (Wanat and Mantiuk 2014,
// "Simulating and compensating changes in appearance between day and night vision"). Knows planes of pixels,
// nothing of files.
#pragma once

#include <memory>

#include "kernel/matrix3.h"
#include "stages/acuity/filter.h"
#include "stages/contrast/sensitivity.h"

namespace scotopic {

/// What the filter is told; everything has its domain.
struct ContrastParameters {
  /// CIE luminance from the linear RGB of the planes: row Y of the matrix to XYZ.
  Vec3<double> luminance = {0.2126, 0.7152, 0.0722};
  double unit = 1.0;                ///< cd/m2 of a luminance of 1 in the image; > 0
  double adaptation = 0.1;          ///< La, cd/m2; > 0
  double pixels_per_degree = 60.0;  ///< > 0, at most 1000
  contrast::DisplayLight display;   ///< what the picture will be shown as
  /// 0: identity; 1: the filter; between: a mixture of the two in linear light.
  double strength = 1.0;
};

/// The filter with all that does not depend on the image worked out. Immutable: share it between threads.
///
/// l = log of luminance plus 1e-3 La, is taken apart in a Laplacian pyramid (Burt and Adelson 1983); band k
/// is about rho = ppd/4 2^-k cycles per degree, as long as that is at least 2. A sample P of a band whose
/// contrast around it is G = max(sqrt(g * P^2), P/sqrt(2)), g the Gaussian of 2 samples, becomes m P,
///
///   m = min(1, max(G - (G_t(rho, La + L) - G_t(rho, min(scale L, peak))), 0.001)/G)
///
/// with L the linear mean of luminance in the next coarser level. RGB is multiplied by what that does to
/// luminance, so hue stays; to what becomes brighter a thousandth of La goes in before, as grey, so that
/// black does.
///
/// What follows: beside a lamp L is high, the thresholds hardly differ, and nothing changes: no halo. A star
/// is dimmed by no more than sqrt(2) times the difference of thresholds, however sparse. A pixel with a
/// component that is not finite or beyond 2^120 passes as it is and is seen by none. Outside the image there
/// is nothing: no padding. A flat picture comes back bit for bit. The result does not depend on tile, window,
/// threads or instruction set by a single bit.
class ContrastFilter : public SpatialFilter {
 public:
  /// Throws std::invalid_argument where a parameter is outside its domain.
  explicit ContrastFilter(const ContrastParameters& parameters);
  ~ContrastFilter() override;
  /// What is moved from can only be destroyed.
  ContrastFilter(ContrastFilter&&) noexcept;
  /// See above.
  ContrastFilter& operator=(ContrastFilter&&) noexcept;

  /// 9 samples of the level below the coarsest band, less 5: 31 pixels at 16 pixels per degree, 139 at 64.
  int halo() const noexcept override;

  /// Bands in use; 0: the filter is the identity.
  int bands() const noexcept;

  /// Scratch memory for each thread: 60 bytes for each pixel of 128 rows and their halo.
  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for = serial_for) const override;

 private:
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

}  // namespace scotopic

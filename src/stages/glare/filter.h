// The light around lamps: what the eye scatters of the light that a display cannot show. Works on whole
// pictures, in place; knows planes of pixels, nothing of files.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "stages/glare/psf.h"
#include "stages/glare/pyramid/ladder.h"
#include "stages/shared/parallel_for.h"

namespace scotopic {
namespace glare {
struct Plan;
}

/// What scatters. The viewer's own eye scatters what the display shows; painting that would count it twice.
enum class GlareRule {
  above,  ///< of each pixel the share max(0, v - t)/v, v = max(R, G, B), t the threshold: hue is kept
  all     ///< everything: the image on the retina, to measure, not to look at
};

/// What the filter is told; everything has its domain.
struct GlareParameters {
  GlareEye eye;
  GlareGrid grid;
  GlareRule rule = GlareRule::above;
  /// The greatest component that the display shows, in units of the image; > 0 and finite. Not used by `all`.
  double threshold = 1;
};

/// A whole picture: planes of width x height pixels, `stride` floats from row to row.
struct GlarePicture {
  /// Linear light that decides what scatters. Not written to unless also in `light`.
  std::array<const float*, 3> rgb{};
  /// Planes that scatter, 1 to 7, each by the share that rgb decides: R, G, B; or L, M, S and rods.
  std::vector<float*> light;
  std::ptrdiff_t stride = 0;
  /// Of each row its greatest_component, where known: rows without light above the threshold are not read
  /// again.
  const float* greatest = nullptr;
};

/// At least the greatest component of the finite pixels of a row, and at least 0. Cheap while the row is in
/// the processor's cache: 0.1 ns a pixel, where reading the picture again for it takes as long as memory
/// does.
float greatest_component(const std::array<const float*, 3>& rgb, int width);

/// Whether a picture calls for glare at all.
struct GlareNeed {
  bool called_for = false;
  std::ptrdiff_t above = 0;  ///< finite pixels with v > threshold
  /// `above`: the largest bound on veil over luminance, of a pixel or of a thousandth of the threshold where
  /// that is more. Exceeds the truth: by 3 in the median. The search ends at the first block that calls for
  /// glare, so it is the largest of those seen. `all`: the largest bound on the relative change of a
  /// component.
  double veil = 0;
  std::string reason;  ///< in words
};

/// The filter with all that does not depend on the picture's light worked out. Immutable: share it between
/// threads.
///
///   out(x) = p(x) + sum over y of K(x - y) m(y) (e(y) - e(x))
///
/// p the picture, e what scatters of it, m = 0 where a component is not finite or beyond 2^120 and else 1, K
/// the glare function over each pixel's square. So: a flat picture comes back bit for bit; the sum over the
/// picture stays what it was, as light that would leave it stays at its source; no value falls below the
/// picture's least; what is not finite passes unchanged and is seen by no other pixel. Float is enough for a
/// range of 1e10 in one picture. K differs from the exact function by 3 % at most, 0.05 to 60 degrees
/// (docs/glare.md).
///
/// Every pixel is taken to subtend 1/ppd degrees: exact in the middle of a perspective picture and at the
/// equator of a panorama; towards corners and poles pixels subtend less (cos^3, cos of the angle), and glare
/// is drawn too narrow.
class GlareFilter {
 public:
  /// Throws std::invalid_argument where a parameter is outside its domain.
  explicit GlareFilter(const GlareParameters& parameters);
  ~GlareFilter();
  /// What is moved from can only be destroyed.
  GlareFilter(GlareFilter&&) noexcept;
  /// See above.
  GlareFilter& operator=(GlareFilter&&) noexcept;

  /// Whether leaving glare out changes what can be seen. `luminance` weighs R, G, B. Where it says no: with
  /// `above`, no pixel's luminance would rise by more than 1 % of itself or of a thousandth of the threshold,
  /// and none above the threshold would fall below it; with `all`, no component would change by more than 1 %
  /// of itself.
  GlareNeed need(const GlarePicture& picture, const std::array<double, 3>& luminance,
                 const ParallelFor& parallel_for = serial_for) const;

  /// Computes picture.light in place. The result does not depend on the threads, nor on the instruction set.
  void apply(const GlarePicture& picture, const ParallelFor& parallel_for = serial_for) const;

  /// What apply allocates for `planes` planes of light on `threads` threads; the picture itself not counted.
  std::size_t bytes(int planes, int threads) const;

  /// Largest share of a pixel's light that can leave it.
  double most_lost() const noexcept;

 private:
  std::unique_ptr<const glare::Plan> plan_;
};

}  // namespace scotopic

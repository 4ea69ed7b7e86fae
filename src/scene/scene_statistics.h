// What a picture holds, measured in one pass over its rows, before anything is decided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "batch/batch.h"
#include "stages/shared/luminance_histogram.h"

namespace scotopic {

/// Whether all components of pixel `i`, and the receptor signals given with it, are finite.
bool is_finite(const PixelRows& rows, std::size_t i) noexcept;
/// Of those signals alone.
bool finite_signals(const PixelRows& rows, std::size_t i) noexcept;

/// Luminances are in image units: cd/m2 once multiplied by the unit.
struct SceneStatistics {
  LuminanceHistogram photopic;
  LuminanceHistogram scotopic;
  std::uint64_t non_finite =
      0;  ///< pixels with a component, of light or receptors, that is NaN or infinite; in no number
  float least = std::numeric_limits<float>::infinity();      ///< of Y over finite pixels; may be negative
  float greatest = -std::numeric_limits<float>::infinity();  ///< below least: there is no finite pixel
  /// Greatest |S/P over white's - 1| among pixels of positive luminance; infinite if rods see light where Y
  /// <= 0.
  float sp_deviation = 0;
  /// RGB triples from all over the picture, for measuring what an effect would do.
  std::vector<float> samples;

  /// Pixels that count.
  std::uint64_t finite() const noexcept { return photopic.count(); }
  /// Arithmetic mean of Y, image units.
  double mean_photopic() const noexcept;
  /// The same of scotopic luminance.
  double mean_scotopic() const noexcept;
  /// S/P ratio of the whole picture's light; white's where there is no light.
  double sp_ratio() const noexcept;
  /// exp(mean(ln(Y + 1e-6 greatest))), image units: what the eye is taken to be adapted to. 0 if all is
  /// black.
  double log_mean_luminance() const noexcept;

  /// Adds what another pass over other rows has found. The order of additions does not matter, but for
  /// samples.
  void add(const SceneStatistics& other);
};

/// How many samples a picture of `pixels` pixels gives, about.
inline constexpr std::uint64_t scene_samples = 4096;

/// Measures rows; immutable, for any number of threads.
class SceneMeter {
 public:
  /// The parameters tell primaries and rods; adaptation and unit are not looked at.
  SceneMeter(const AppearanceParameters& parameters, std::uint64_t pixels_in_subimage);

  /// Adds `rows` to `statistics`; its first pixel is number `first_pixel` of the picture.
  void measure(const PixelRows& rows, std::uint64_t first_pixel, SceneStatistics& statistics) const;

 private:
  Matrix3<double> xyz_from_rgb_;
  Vec3<float> y_row_;
  RodEstimate rods_;
  double sp_ratio_;
  double white_scotopic_;  // of a white of luminance 1
  std::uint64_t sample_every_;
};

}  // namespace scotopic

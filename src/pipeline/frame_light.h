// The light of a whole picture at once, for stages that look at all of it (glare). Other stages go on in bands, from here.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/apply_image.h"
#include "stages/glare/filter.h"

namespace scotopic {

/// Planes of one picture: linear working RGB, and receptors' signals where the file has them.
class FrameLight {
 public:
  /// Room for a picture of these sizes.
  FrameLight(int width, int height, bool receptors);

  /// Bytes of such a picture.
  static std::int64_t bytes(const Picture& picture, bool receptors);

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  bool receptors() const noexcept { return receptors_; }
  /// Row y, counted from the top of the data window.
  void set_row(int y, const LightRow& light);
  /// Puts row y in place of what a reader has read.
  void get_row(int y, LightRow& light) const;
  /// The same as the operator takes it, from column x on.
  PixelRows row(int y, int x, int count) noexcept;
  /// What glare decides by, and what it scatters: R, G, B, and receptors' own signals.
  GlarePicture glare_picture() noexcept;

 private:
  int width_, height_;
  bool receptors_;
  std::vector<std::vector<float>> planes_;  // R, G, B; L, M, S, rods
};

/// The light of one picture of the source.
FrameLight read_frame(PixelSource& source, const LightPicture& light, const ColourConfig& config);

/// measure_image() of light that is here already.
SceneStatistics measure_frame(FrameLight& frame, const Picture& picture, const AppearanceParameters& parameters,
                              const std::optional<Window>& region = std::nullopt);

/// All threads of the pool, for stages that are handed them.
ParallelFor pool_for();

}  // namespace scotopic

// The light of whole subimages, for stages that need all of it at once.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/layout/layout.h"
#include "pipeline/rows/row_codec.h"
#include "pipeline/rows/non_finite.h"
#include "pipeline/rows/stages.h"

namespace scotopic {

/// One subimage as planes of float.
class LightPlanes {
 public:
  /// Room for the pixels of `subimage`.
  LightPlanes(const Subimage& subimage, bool receptors, const Moment& moment);

  /// Bytes of the planes.
  static std::int64_t bytes(const Subimage& subimage, bool receptors);

  /// Takes row `y`, counted from the data window's first; any thread.
  void set_row(int y, const LightRow& light);
  /// Replaces the light of `light`, as the file has it, by that of the planes from column `x` on;
  /// light.changed says where they differ. Any thread.
  void replace(int y, int x, LightRow& light) const;
  /// The light of row `y`; any thread.
  void get(int y, LightRow& light) const;
  /// For a stage to work on.
  FramePlanes planes();
  /// Said by whoever has changed them.
  void changed() { greatest_.clear(); }

 private:
  std::size_t at(int y, int x) const;

  int width_, height_;
  bool receptors_;
  RowContext corner_;
  std::vector<float> planes_[7];
  std::vector<float> greatest_;  ///< component of each row, as long as nobody has changed any
};

/// Those of an image, one for each of layout.light; null for smaller resolutions, and where no stage has
/// changed any.
struct FrameLights {
  std::vector<std::unique_ptr<LightPlanes>> subimages;
  NonFinitePixels non_finite;  ///< of the file's pixels

  /// Of layout.light[index]; nullptr where no stage needs whole subimages.
  const LightPlanes* of(std::size_t index) const {
    return index < subimages.size() ? subimages[index].get() : nullptr;
  }
};

/// Decodes the light of a file at full resolution: one pass. Error(input) for pixels that are not finite
/// where the policy says so.
FrameLights decode_frames(PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                          NonFinite policy, const Moment& moment);

/// What the planes of all subimages and the stage that needs most take, rows on their way included.
std::int64_t frame_bytes(const PixelSource& source, const ImageLayout& layout, const FrameStages& stages,
                         const StageScene& scene);

}  // namespace scotopic

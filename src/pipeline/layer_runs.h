// All layers of light of one subimage, each on its own way through the stages, back into one subimage.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

#include "pipeline/rows/subimage_run.h"

namespace scotopic {

/// What it is given must outlive it.
class LayerRuns {
 public:
  /// `out` is of `layout`, and no copy; `interleaved` as the sink wants bands.
  LayerRuns(const PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
            const ImageStages& stages, const OutputSubimage& out, bool descending, bool interleaved);

  /// The next band of the file; `write` gets each that is done, in the order of their coming.
  void run(Band&& in, const std::function<void(const Band&)>& write);

  /// Pixels of the file that have passed and are not finite, layer by layer.
  NonFinitePixels non_finite() const;

 private:
  void filter(std::size_t layer, Band&& in);
  Band& place(std::size_t i);

  bool interleaved_;
  std::deque<SubimageRun> runs_;
  std::vector<std::deque<AcuityRows>> filters_;  // of each layer
  std::deque<Band> done_;                        // kept for their room
  std::size_t done_count_ = 0;
};

}  // namespace scotopic

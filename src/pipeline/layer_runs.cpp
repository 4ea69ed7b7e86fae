#include "pipeline/layer_runs.h"

#include <utility>

namespace scotopic {
namespace {

/// A copy with a place of its own.
Band copy_of(const Band& band) {
  Band out = band;
  for (std::size_t c = 0; c < out.channels.size(); ++c)
    out.channels[c].data = out.storage.data() + (band.channels[c].data - band.storage.data());
  return out;
}

}  // namespace

LayerRuns::LayerRuns(const PixelSource& source, const ImageLayout& layout, const ColourConfig& config,
                     const ImageStages& stages, const OutputSubimage& out, bool descending, bool interleaved)
    : interleaved_(interleaved) {
  for (std::size_t layer = 0; layer < layout.lights_of(out.source).size(); ++layer) {
    const SubimageRun& run = runs_.emplace_back(source, layout, config, stages, out, layer);
    filters_.push_back(run.filter_rows(descending, true));
  }
}

void LayerRuns::run(Band&& in, const std::function<void(const Band&)>& write) {
  done_count_ = 0;
  if (filters_.front().empty()) {
    Band& out = place(done_count_++);
    runs_.front().allocate(in, out, interleaved_);
    for (const SubimageRun& run : runs_) run.run(in, out);
  } else {
    std::vector<Band> copies;
    for (std::size_t layer = 1; layer < runs_.size(); ++layer) copies.push_back(copy_of(in));
    filter(0, std::move(in));
    in = Band();
    for (std::size_t layer = 1; layer < runs_.size(); ++layer) filter(layer, std::move(copies[layer - 1]));
  }
  for (std::size_t i = 0; i < done_count_; ++i) write(done_[i]);
}

// Filters of all layers have the same halo: the same bands come out of each.
void LayerRuns::filter(std::size_t layer, Band&& in) {
  std::size_t i = 0;
  runs_[layer].run(std::move(in), filters_[layer], [&](const Band& seen) -> const Band& {
    Band& out = place(i++);
    if (layer == 0) runs_[layer].allocate(seen, out, interleaved_);
    return out;
  });
  done_count_ = i;
}

Band& LayerRuns::place(std::size_t i) {
  while (done_.size() <= i) done_.emplace_back();
  return done_[i];
}

NonFinitePixels LayerRuns::non_finite() const {
  NonFinitePixels all;
  for (const SubimageRun& run : runs_) all.add(run.non_finite());
  return all;
}

}  // namespace scotopic

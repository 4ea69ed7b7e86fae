#include "pipeline/memory/tile_filter.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace scotopic {
namespace {

/// Pixels of a tile that lie its halo away from every side that is not the image's own; from its corner.
Window within(const Window& data, const Window& whole, int halo) {
  const auto inset = [halo](bool at_the_side) { return at_the_side ? 0 : halo; };
  return {inset(data.x0 <= whole.x0), inset(data.y0 <= whole.y0), data.width() - inset(data.x1 >= whole.x1),
          data.height() - inset(data.y1 >= whole.y1)};
}

/// What of it lies in a window.
AcuityTile clipped(const AcuityTile& tile, const Window& to) {
  AcuityTile out = tile;
  out.x = std::max(tile.x, to.x0);
  out.y = std::max(tile.y, to.y0);
  out.width = std::max(0, std::min(tile.x + tile.width, to.x1) - out.x);
  out.height = std::max(0, std::min(tile.y + tile.height, to.y1) - out.y);
  if (out.width == 0 || out.height == 0) return {};
  const std::ptrdiff_t at = (out.y - tile.y) * tile.stride + out.x - tile.x;
  out.r += at;
  out.g += at;
  out.b += at;
  return out;
}

/// Takes windows and tiles in the tile's coordinates to the filter in those of the whole.
class TileFilter : public SpatialFilter {
 public:
  TileFilter(std::unique_ptr<SpatialFilter> filter, const Window& data, const Window& whole)
      : filter_(std::move(filter)),
        x_(data.x0 - whole.x0),
        y_(data.y0 - whole.y0),
        width_(whole.width()),
        height_(whole.height()),
        within_(within(data, whole, filter_->halo())) {}

  int halo() const noexcept override { return filter_->halo(); }

  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for) const override {
    AcuityTile part = clipped(tile, within_);
    if (part.width < tile.width || part.height < tile.height) copy_tile(window, tile);
    if (part.width == 0) return;
    AcuityWindow seen = window;
    seen.x += x_;
    seen.y += y_;
    seen.image_width = width_;
    seen.image_height = height_;
    part.x += x_;
    part.y += y_;
    filter_->filter(seen, part, parallel_for);
  }

 private:
  std::unique_ptr<SpatialFilter> filter_;
  int x_, y_, width_, height_;
  Window within_;
};

class TileStage : public FilterStage {
 public:
  TileStage(std::shared_ptr<const FilterStage> stage, const Window& data, const Window& whole)
      : stage_(std::move(stage)), data_(data), whole_(whole) {}

  std::string_view name() const noexcept override { return stage_->name(); }
  EffectDecision decide(const StageScene& scene) const override { return stage_->decide(scene); }
  std::vector<Attribute> stamps(const StageScene& scene) const override { return stage_->stamps(scene); }
  std::unique_ptr<SpatialFilter> make(const StageScene& scene, const Notes& notes) const override {
    return std::make_unique<TileFilter>(stage_->make(scene, notes), data_, whole_);
  }

 private:
  std::shared_ptr<const FilterStage> stage_;
  Window data_, whole_;
};

}  // namespace

FilterStages stages_on_tile(const FilterStages& stages, const Window& data, const Window& whole) {
  FilterStages out;
  for (const auto& stage : stages) out.push_back(std::make_shared<const TileStage>(stage, data, whole));
  return out;
}

}  // namespace scotopic

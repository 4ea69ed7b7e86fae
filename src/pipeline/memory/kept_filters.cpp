#include "pipeline/memory/kept_filters.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scotopic {
namespace {

/// What differs between the scenes that one stage is told of; the rest are settings.
struct Key {
  explicit Key(const StageScene& s)
      : adaptation(s.parameters.adaptation),
        white_luminance(s.parameters.white_luminance),
        rod_adaptation(s.parameters.rod_adaptation),
        pixels_per_degree(s.resolution.pixels_per_degree),
        pixel_aspect(s.resolution.pixel_aspect),
        source(s.resolution.source),
        wraps(s.wraps) {}
  bool operator==(const Key&) const = default;

  double adaptation, white_luminance;
  std::optional<double> rod_adaptation;
  double pixels_per_degree, pixel_aspect;
  std::string source;
  bool wraps;
};

class SharedFilter : public SpatialFilter {
 public:
  explicit SharedFilter(std::shared_ptr<const SpatialFilter> filter) : filter_(std::move(filter)) {}
  int halo() const noexcept override { return filter_->halo(); }
  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for) const override {
    filter_->filter(window, tile, parallel_for);
  }

 private:
  std::shared_ptr<const SpatialFilter> filter_;
};

struct Kept {
  Key key;
  std::shared_ptr<const SpatialFilter> filter;
  std::vector<std::string> notes, details;
};

class KeepingStage : public FilterStage {
 public:
  explicit KeepingStage(std::shared_ptr<const FilterStage> stage) : stage_(std::move(stage)) {}

  std::string_view name() const noexcept override { return stage_->name(); }
  EffectDecision decide(const StageScene& scene) const override { return stage_->decide(scene); }
  std::vector<Attribute> stamps(const StageScene& scene) const override { return stage_->stamps(scene); }
  std::unique_ptr<SpatialFilter> make(const StageScene& scene, const Notes& notes) const override {
    if (scene.adapting) return stage_->make(scene, notes);
    const std::shared_ptr<const Kept> kept = kept_for(scene);
    for (const std::string& line : kept->notes) notes.note(line);
    for (const std::string& line : kept->details) notes.detail(line);
    return std::make_unique<SharedFilter>(kept->filter);
  }

 private:
  /// Threads that ask for the same wait for the first.
  std::shared_ptr<const Kept> kept_for(const StageScene& scene) const {
    const Key key(scene);
    const std::lock_guard guard(lock_);
    if (last_ && last_->key == key) return last_;
    auto made = std::make_shared<Kept>(Kept{key, nullptr, {}, {}});
    made->filter = stage_->make(scene, {[&](const std::string& line) { made->notes.push_back(line); },
                                        [&](const std::string& line) { made->details.push_back(line); }});
    last_ = std::move(made);
    return last_;
  }

  std::shared_ptr<const FilterStage> stage_;
  mutable std::mutex lock_;
  mutable std::shared_ptr<const Kept> last_;
};

}  // namespace

FilterStages kept_filters(const FilterStages& stages) {
  FilterStages out;
  for (const auto& stage : stages) out.push_back(std::make_shared<const KeepingStage>(stage));
  return out;
}

}  // namespace scotopic

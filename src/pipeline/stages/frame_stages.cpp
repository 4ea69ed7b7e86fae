#include "pipeline/stages/frame_stages.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "io/pixels/row_bands.h"
#include "pipeline/scene/angular_resolution.h"

namespace scotopic {
namespace {

void on_all_threads(int count, const std::function<void(int)>& task) {
  parallel_rows(count, 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) task(i);
  });
}

}  // namespace

FramesOfImage::FramesOfImage(OpenImage& image, const ImageSettings& settings, const Moment& moment,
                             const Notes& notes)
    : image_(image), settings_(settings) {
  scene_.parameters = settings.choice.parameters;
  scene_.resolution = angular_resolution(settings.viewing, *image.source, image.layout);
  scene_.wraps = image.layout.wraps;
  choose();
  if (any()) decode(moment, notes);
}

void FramesOfImage::choose() {
  for (const auto& stage : settings_.frame_stages) {
    try {
      decisions_.push_back(stage->decide(scene_));
    } catch (const Error& error) {
      throw Error(error.code(), image_.source->file(), error.what());
    }
    if (decisions_.back().asked) stages_.push_back(stage);
  }
}

void FramesOfImage::decode(const Moment& moment, const Notes& notes) {
  const std::string& file = image_.source->file();
  bytes_ = frame_bytes(*image_.source, image_.layout, stages_, scene_);
  check_limit(file, "bytes of memory planned", bytes_, settings_.limits.memory, "--max-memory");
  notes.detail(fmt::format("{}: the whole picture is kept: {:.1f} MB of memory", file,
                           static_cast<double>(bytes_) / 1e6));
  lights_ = decode_frames(*image_.source, image_.layout, settings_.config, settings_.non_finite, moment);
}

bool FramesOfImage::run(const SceneNumbers& numbers) {
  scene_.parameters = parameters_of(settings_.choice, numbers.adaptation, numbers.white_luminance);
  changed_.resize(lights_.subimages.size());
  for (std::size_t i = 0; i < decisions_.size(); ++i)
    if (decisions_[i].asked) run(*settings_.frame_stages[i], decisions_[i]);
  return std::find(changed_.begin(), changed_.end(), true) != changed_.end();
}

void FramesOfImage::run(const FrameStage& stage, EffectDecision& decision) {
  for (std::size_t i = 0; i < lights_.subimages.size(); ++i) {
    if (!lights_.subimages[i]) continue;
    const FrameOutcome outcome = stage.run(lights_.subimages[i]->planes(), scene_, on_all_threads);
    decision.number += outcome.number;
    decision.reason = outcome.reason;
    decision.needed = decision.needed || outcome.ran;
    if (outcome.ran) lights_.subimages[i]->changed();
    changed_[i] = changed_[i] || outcome.ran;
  }
  decision.share = decision.needed ? 1 : 0;
  if (!decision.needed) return;
  const std::vector<Attribute> said = stage.stamps(scene_);
  stamps_.insert(stamps_.end(), said.begin(), said.end());
}

void FramesOfImage::forget_unchanged() {
  for (std::size_t i = 0; i < changed_.size(); ++i)
    if (!changed_[i]) lights_.subimages[i].reset();
}

}  // namespace scotopic

// The stages of whole pictures on one image: which are asked for, the memory they take, and what they make of
// its light.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/notes.h"
#include "pipeline/rows/frame_light.h"
#include "pipeline/scene/open_image.h"
#include "pipeline/scene/scene_numbers.h"
#include "pipeline/settings.h"

namespace scotopic {

/// The image and the settings must outlive it.
class FramesOfImage {
 public:
  /// Plans memory, then decodes the image if any stage is asked for. Error(limit) before anything is
  /// allocated that is more than the limits allow.
  FramesOfImage(OpenImage& image, const ImageSettings& settings, const Moment& moment, const Notes& notes);

  /// Whether any stage is asked for.
  bool any() const { return !stages_.empty(); }
  /// nullptr for none.
  const FrameLights* lights() const { return any() ? &lights_ : nullptr; }
  /// Bytes planned.
  std::int64_t bytes() const { return bytes_; }

  /// Runs them for a scene with these numbers; true if any picture was changed.
  bool run(const SceneNumbers& numbers);
  /// Pictures that nothing has changed go on from the file, whose bytes may stay.
  void forget_unchanged();

  /// About each stage of the settings.
  const std::vector<EffectDecision>& decisions() const { return decisions_; }
  /// Of those that changed a picture.
  const std::vector<Attribute>& stamps() const { return stamps_; }

 private:
  void choose();
  void decode(const Moment& moment, const Notes& notes);
  void run(const FrameStage& stage, EffectDecision& decision);

  OpenImage& image_;
  const ImageSettings& settings_;
  StageScene scene_;
  FrameStages stages_;
  std::vector<EffectDecision> decisions_;
  std::vector<Attribute> stamps_;
  std::int64_t bytes_ = 0;
  FrameLights lights_;
  std::vector<bool> changed_;  // of lights_.pictures
};

}  // namespace scotopic

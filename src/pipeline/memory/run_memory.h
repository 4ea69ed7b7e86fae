// One image from memory to memory: the stages of run.h, for hosts that hold the pixels.
#pragma once

#include <optional>

#include "pipeline/memory/memory_source.h"
#include "pipeline/run.h"

namespace scotopic {

/// One image to be made.
struct MemoryJob {
  MemoryPixels in;
  MemoryHeader header;  ///< header.data is where `in` lies
  /// Takes the result: as many channels, and of the same type. May be `in` itself, but may not overlap it in
  /// any other way.
  MemoryPixels out;
  Window window;             ///< where `out` lies; of its pixels those inside header.data are written
  std::optional<int> frame;  ///< its number in a sequence; nullopt: a still
  std::optional<TrackedAdaptation> adaptation;  ///< in place of the settings'
  Progress progress;
};

/// As run_image() from OpenEXR to OpenEXR, pixels alone; where no colour space is asked for, values are in
/// the config's working space. After an Error the pixels of `out` are undefined.
ImageReport run_image(const MemoryJob& job, const ImageSettings& settings, EvaluatorSource& evaluators,
                      const Notes& notes);

/// Pixels per degree of such an image; only its header is looked at.
AngularResolution resolution_in_memory(const ImageSettings& settings, const MemoryJob& job);

/// The space that results are in, where that is another than the input's.
std::optional<ColourSpace> new_space_in_memory(const ImageSettings& settings);

/// As read_scene(): `out` and `window` are not looked at.
SceneReport read_scene(const MemoryJob& job, const ImageSettings& settings, Statistics wanted,
                       const Notes& notes);

}  // namespace scotopic

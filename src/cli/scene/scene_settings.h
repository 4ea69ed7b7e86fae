// What apply and explain share: how a scene is to be understood, worked out once, and one image opened by it.
#pragma once

#include <memory>

#include "cli/options/acuity_options.h"
#include "cli/sequence/frame_job.h"
#include "cli/options/image_options.h"
#include "cli/options/operator_options.h"
#include "cli/scene/scene_numbers.h"
#include "cli/options/spectral_options.h"

namespace scotopic {

/// As typed.
struct SceneOptions {
  OperatorOptions appearance;
  BandOptions bands;
  AcuityOptions acuity;
  ImageOptions image;
};

/// As understood, with the colour config; the same for all images. Faults are told in this order.
struct SceneSettings {
  SceneSettings(const SceneOptions& options, int threads);

  OperatorChoice choice;
  AcuityChoice acuity;
  ImageRequest request;
  Limits limits;
  SpectralOptions spectral;
  ColourConfig config;
};

/// An image that is open, its pixels not looked at.
struct Scene {
  std::unique_ptr<PixelSource> source;
  ImageLayout layout;
  KnownNumbers known;
};

/// `output` decides what the image will become; "none.exr" where nothing is written.
Scene open_scene(const SceneSettings& settings, const std::string& input, const std::string& output,
                 const Console& console);

/// The scene's statistics, and its numbers; `statistics` are those of all pixels if `always`, else only where the
/// adaptation depends on them.
struct MeteredScene {
  std::optional<SceneStatistics> statistics;
  SceneNumbers numbers;
};
MeteredScene meter(Scene& scene, const SceneSettings& settings, bool always);

}  // namespace scotopic

// What apply and explain share: options of a scene, as typed, and the settings they stand for.
#pragma once

#include "options/viewing_options.h"
#include "options/image_options.h"
#include "options/operator_options.h"
#include "options/spectral_options.h"
#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct SceneOptions {
  OperatorOptions appearance;
  BandOptions bands;
  ViewingOptions viewing;
  std::string history;  ///< --adaptation-history
  ImageOptions image;
};

/// All that both verbs have but an image's own.
void add_scene_options(CLI::App& verb, SceneOptions& options);

/// With the colour config in force; add_stages() is still to be called. Faults are told in the order of the
/// options' groups.
ImageSettings parse(const SceneOptions& options);

}  // namespace scotopic

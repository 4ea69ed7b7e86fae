// What apply and explain share: options of a scene, as typed, and the settings they stand for.
#pragma once

#include "cli/console.h"
#include "cli/options/acuity_options.h"
#include "cli/options/image_options.h"
#include "cli/options/operator_options.h"
#include "cli/options/spectral_options.h"
#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct SceneOptions {
  OperatorOptions appearance;
  BandOptions bands;
  AcuityOptions acuity;
  ImageOptions image;
};

/// With the colour config in force. Faults are told in the order of the options' groups.
ImageSettings understand(const SceneOptions& options);

}  // namespace scotopic

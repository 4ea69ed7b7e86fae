// The options of apply, and the settings they stand for: shared with hosts that give the same by name.
#pragma once

#include <memory>
#include <string>

#include "options/display_options.h"
#include "options/icc_options.h"
#include "options/scene/precision_options.h"
#include "options/scene/scene_settings.h"
#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct ApplyOptions {
  SceneOptions scene;
  PrecisionOptions precision;
  DisplayOptions display;
  IccOptions icc;
  std::string non_finite = "keep";
};

/// All but those of a scene (add_scene_options), of input, output and ICC.
void add_apply_options(CLI::App& verb, ApplyOptions& options);

/// In the order in which faults are to be told; see parse(SceneOptions).
ImageSettings parse(const ApplyOptions& options);

}  // namespace scotopic

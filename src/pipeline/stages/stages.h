// What the table's lines add to the way of an image, a file for each stage.
#pragma once

#include "pipeline/settings.h"

namespace scotopic {

/// Light that scatters in the eye, on whole pictures.
void add_glare(const StageValues& values, ImageSettings& settings);
/// What an eye sees that is used to a lamp's colour.
void add_lamp(const StageValues& values, ImageSettings& settings);
/// The exposure of an eye that is still adapting.
void add_time(const StageValues& values, ImageSettings& settings);
/// The loss of detail, by contrast or by acuity.
void add_detail(const StageValues& values, ImageSettings& settings);
/// The rods' noise.
void add_noise(const StageValues& values, ImageSettings& settings);

/// What a stage that needs pixels per degree decides before it looks at the scene: asked for by name, or
/// wished for where they are known. Error(usage) for the first where they are not. safko2019 has none of
/// these stages, unless `named`: an option of the stage itself calls for it.
EffectDecision asked_at_resolution(const StageValues& values, const StageDescription& stage, bool named,
                                   const StageScene& scene);

}  // namespace scotopic

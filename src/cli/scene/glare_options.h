// The options of stage glare, and the stage on a scene.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "batch/display_batch.h"
#include "cli/options/acuity_options.h"
#include "cli/options/operator_options.h"
#include "pipeline/frame_light.h"
#include "scene/plan.h"

namespace scotopic {

/// As typed.
struct GlareOptions {
  std::string rule = "above";
  std::string age = "28.58";
  std::string pigmentation = "0.5";
  std::string strength = "1";
};

/// As understood.
struct GlareChoice {
  GlareRule rule = GlareRule::above;
  std::optional<double> threshold;  ///< image units; nullopt: what the display cannot show
  GlareEye eye;
  double strength = 1;
  bool off = false;  ///< --glare none
  bool named = false;  ///< --glare was given
};

void add_glare_options(CLI::App& verb, GlareOptions& options);

/// Error(usage) for a value that is not understood.
GlareChoice understand(const GlareOptions& options);

/// What glare is computed with, and what became of it.
struct GlareOutcome {
  EffectDecision decision;
  FrameLights frames;  ///< empty where it did not run
  std::vector<Attribute> stamps;
};

/// Where an effect is wished, whether the scene calls for it; scatters the light of every picture of full resolution if so.
/// `threshold`: image units, of what a display cannot show. Error(usage) where it is asked for by name and pixels per
/// degree are not known; Error(limit) before anything is allocated that is more than `limits` allow.
GlareOutcome scatter(const GlareChoice& choice, EffectWish wish, double threshold, PixelSource& source,
                     const ImageLayout& layout, const ColourConfig& config, const AppearanceParameters& parameters,
                     const AngularResolution& resolution, bool panorama, const Limits& limits);

}  // namespace scotopic

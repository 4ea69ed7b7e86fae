// The options that describe what the operator does: the same words in every verb.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "stages/shared/parameters.h"
#include "cli/options/spectral_options.h"
#include "cli/scene/adaptation_method.h"
#include "color/colour_config.h"

namespace scotopic {

/// As typed.
struct OperatorOptions {
  std::string adaptation = "auto";
  std::string white_luminance;
  std::string model = "filament2021";
  std::string safko_scale;
  std::string effects = "auto";
  std::string strength = "1";
  std::string strength_shift = "1";
  std::string strength_luminance = "1";
  std::string strength_chroma = "1";
  std::string weight = "local";
  std::string luminance = "mesopic";
  std::string gamut = "working";
  std::string illuminant = "d65";
  std::string rods = "linear";
};

/// Whether --effects asks for a stage that looks at neighbours: in a list by name; all and auto only where pixels per
/// degree are known.
enum class EffectWish { no, if_known, yes };

/// As understood. Adaptation, white luminance and primaries in `parameters` are not set yet.
struct OperatorChoice {
  AppearanceParameters parameters;
  std::optional<double> adaptation;       ///< nullopt: auto, by `metering`
  std::string adaptation_source = "--adaptation";
  AdaptationMethod metering;
  std::optional<double> white_luminance;  ///< nullopt: the file's, or from the adaptation
  bool plan_effects = false;              ///< --effects auto
  EffectWish acuity = EffectWish::no;
  EffectWish glare = EffectWish::no;
  std::string gamut;
  IlluminantChoice illuminant;
};

void add_operator_options(CLI::App& verb, OperatorOptions& options);

/// Error(usage) for the first value that is not understood. Looks at nothing but the text, and an
/// illuminant.s file.
OperatorChoice understand(const OperatorOptions& options);

/// Sets the primaries: those of the config's working space, and of the gamut chosen.
void set_primaries(OperatorChoice& choice, const ColourConfig& config);

/// What was asked for and the model has not got: "--strength, --gamut"; empty where there is nothing of the kind.
std::string without_effect(const OperatorOptions& options, const AppearanceParameters& parameters);

/// Names for messages and metadata.
std::string model_name(Model model);
std::string weight_name(Weight weight);
std::string luminance_name(LuminancePolicy policy);
std::string rods_name(RodEstimate rods);

}  // namespace scotopic

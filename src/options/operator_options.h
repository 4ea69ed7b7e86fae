// The options that describe what the operator does: the same words in every verb.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "options/spectral_options.h"
#include "options/scene/stage_options.h"
#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct OperatorOptions {
  std::string adaptation = "auto";
  std::string white_luminance;
  std::string model = "filament2021";
  std::string safko_scale;
  std::string strength = "1";
  StageOptions stages;
  std::string weight = "local";
  std::string luminance = "mesopic";
  std::string gamut = "working";
  std::string illuminant = "d65";
  std::string adapt_white;
  std::string rods = "linear";
};

/// With the options of the stages that the verb has.
void add_operator_options(CLI::App& verb, OperatorOptions& options, StagesShown shown = StagesShown::fused);

/// Error(usage) for the first value that is not understood. Looks at nothing but the text, and an
/// illuminant.s file.
OperatorChoice parse(const OperatorOptions& options);

/// What was asked for and the model has not got: "--strength, --gamut"; empty where there is nothing of the
/// kind.
std::string without_effect(const OperatorOptions& options, const OperatorChoice& choice);

}  // namespace scotopic

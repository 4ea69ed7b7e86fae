// The options of all stages, made from the table.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "pipeline/stages/stage_values.h"

namespace scotopic {

/// Which stages a verb has options for.
enum class StagesShown {
  fused,  ///< the pixel stages
  look,   ///< what a look holds: these, and the lamp before them
  all,
};

/// As typed.
struct StageOptions {
  StageTable table = shipped_stages();
  std::string effects = "auto";
  std::map<std::string, std::string, std::less<>> typed;  ///< by the parameters' names; empty: not given
  std::string acuity = "off";                             ///< the older way to call for detail
};

/// --effects, and an option for each parameter.
void add_stage_options(CLI::App& verb, StageOptions& options, StagesShown shown);

/// Error(usage) for a value that is not understood.
StageValues parse(const StageOptions& options);

}  // namespace scotopic

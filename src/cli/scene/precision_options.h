// How the operator is computed: by name, or the cheapest way that is accurate enough.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "looks/verify/way_choice.h"
#include "cli/console.h"

namespace scotopic {

/// As typed.
struct PrecisionOptions {
  std::string precision = "float";
  std::string max_error;
  std::string budget;
};

void add_precision_options(CLI::App& verb, PrecisionOptions& options);

struct PrecisionChoice {
  const Way* way = nullptr;  ///< where nothing is demanded
  WayDemand demand;
};

/// Error(usage) for a value that is not understood.
PrecisionChoice understand(const PrecisionOptions& options);

/// A way, ready, and what is to be said of it.
struct ChosenWay {
  std::string name;
  RowOperator apply;
  nlohmann::ordered_json report;  ///< for --json; null where nothing was demanded
};

/// Measures where something is demanded, and says what was picked. `receptors`: pixels bring signals of their
/// own, for which no LUT will do: Error(usage) if one is asked for by name. Error(limit) if no way meets the
/// demand.
ChosenWay settle(const PrecisionChoice& choice, const AppearanceParameters& parameters, bool receptors,
                 const Console& console);

}  // namespace scotopic

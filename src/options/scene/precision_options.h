// How the operator is computed: by name, or the cheapest evaluator that is accurate enough.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "pipeline/evaluator.h"

namespace scotopic {

/// As typed.
struct PrecisionOptions {
  std::string precision = "float";
  std::string max_error;
  std::string budget;
};

void add_precision_options(CLI::App& verb, PrecisionOptions& options);

/// Error(usage) for a value that is not understood.
std::unique_ptr<EvaluatorSource> parse(const PrecisionOptions& options);

}  // namespace scotopic

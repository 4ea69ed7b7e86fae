// The options of stage glare.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct GlareOptions {
  std::string rule = "above";
  std::string age = "28.58";
  std::string pigmentation = "0.5";
  std::string strength = "1";
};

void add_glare_options(CLI::App& verb, GlareOptions& options);

/// Error(usage) for a value that is not understood.
GlareChoice understand(const GlareOptions& options);

}  // namespace scotopic

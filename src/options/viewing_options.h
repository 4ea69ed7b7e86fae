// How large the picture is to its viewer.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct ViewingOptions {
  std::string pixels_per_degree;
  std::string field_of_view;
  std::string projection;
};

void add_viewing_options(CLI::App& verb, ViewingOptions& options);

/// Error(usage) for a value that is not understood, and for --ppd beside --fov.
ViewingChoice parse(const ViewingOptions& options);

}  // namespace scotopic

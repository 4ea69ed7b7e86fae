// The options of the acuity filter.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pipeline/settings.h"

namespace scotopic {

/// As typed.
struct AcuityOptions {
  std::string acuity = "off";
  std::string strength = "1";
  std::string space = "light";
  std::string quality = "normal";
  std::string range = "15";
  std::string pixels_per_degree;
  std::string field_of_view;
  std::string projection;
};

void add_acuity_options(CLI::App& verb, AcuityOptions& options);

/// Error(usage) for a value that is not understood, and for --ppd or --fov given without use or both.
AcuityChoice understand(const AcuityOptions& options);

}  // namespace scotopic

#include "cli/scene_numbers.h"

#include <fmt/format.h>

#include "image/error.h"

namespace scotopic {
namespace {

// Photographic middle grey: the reflectance that a scene's log-average is taken to be.
constexpr double middle_grey = 0.18;

std::optional<double> unit_of(const KnownNumbers& known) {
  return known.white_luminance ? known.white_luminance : known.file_unit;
}

}  // namespace

bool needs_measurement(const KnownNumbers& known, const std::string& file) {
  if (known.adaptation) return false;
  if (!unit_of(known))
    throw Error(ExitCode::usage, file, "absolute luminance unknown: give --adaptation or --white-luminance");
  return true;
}

SceneNumbers settle(const KnownNumbers& known, double log_average, const std::string& file) {
  SceneNumbers out;
  const std::optional<double> unit = unit_of(known);
  if (known.adaptation) {
    out.adaptation = *known.adaptation;
    out.adaptation_source = "--adaptation";
  } else {
    out.adaptation = log_average * unit.value();
    out.adaptation_source = "auto: log-average of the picture";
    if (!(out.adaptation > 0))
      throw Error(ExitCode::input, file, "is black: it adapts the eye to nothing; give --adaptation");
  }
  out.white_luminance = unit.value_or(out.adaptation / middle_grey);
  out.white_luminance_source = known.white_luminance ? "--white-luminance"
                               : known.file_unit
                                   ? known.file_unit_source
                                   : "adaptation/.18: middle grey is what the eye is adapted to";
  return out;
}

std::string describe(const SceneNumbers& n) {
  return fmt::format("adaptation {:.4g} cd/m2 ({}), image value 1 is {:.4g} cd/m2 ({})", n.adaptation,
                     n.adaptation_source, n.white_luminance, n.white_luminance_source);
}

}  // namespace scotopic

#include "looks/lut/shipped_looks.h"

#include "stages/limits.h"
#include "looks/lut/look_chain.h"
#include "looks/lut/look_matrix.h"
#include "looks/chain/number_text.h"

namespace scotopic {

std::string adaptation_text(double adaptation) {
  return adaptation >= 1e-4 && adaptation < 1e6 ? fixed_text(adaptation, 9) : number_text(adaptation);
}

bool is_identity(const AppearanceParameters& p) {
  const std::optional<Matrix3<double>> matrix = look_matrix(p);
  return matrix && matrix->rows == identity3<double>().rows;
}

namespace {

/// "0.1 nit (street lighting)".
std::string adaptation_name(double adaptation) {
  std::string name = adaptation_text(adaptation) + " nit";
  for (const NamedAdaptation& step : named_adaptations)
    if (step.adaptation == adaptation) name += " (" + std::string(step.scene) + ")";
  return name;
}

}  // namespace

std::string night_name(double adaptation) { return "Night " + adaptation_name(adaptation); }

std::string night_file_stem(const LookSpec& spec) {
  const std::string peak = spec.night->peak == display_white ? "" : "_" + adaptation_text(spec.night->peak);
  return "night_" + spec.display + peak + "_" + adaptation_text(spec.parameters.adaptation);
}

std::string look_name(const AppearanceParameters& p) {
  const bool photopic = p.model != Model::safko2019 && !(p.adaptation < photopic_limit);
  std::string name = (photopic ? "Photopic " : "Mesopic ") + adaptation_name(p.adaptation);
  if (p.model != Model::filament2021) name += " " + std::string(name_of(p.model));
  return name;
}

std::string look_file_stem(const AppearanceParameters& p) {
  return std::string(name_of(p.model)) + "_" + adaptation_text(p.adaptation);
}

}  // namespace scotopic

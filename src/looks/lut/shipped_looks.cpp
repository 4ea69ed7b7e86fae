#include "looks/lut/shipped_looks.h"

#include <fmt/format.h>

#include <algorithm>

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

bool is_identity(const LookSpec& spec) { return !spec.lamp && is_identity(spec.parameters); }

namespace {

/// " lamp 0.5266 0.4133".
std::string lamp_name(const LookSpec& spec) {
  if (!spec.lamp) return "";
  const double surround = spec.lamp->surround;
  return fmt::format(" lamp {:.4f} {:.4f}{}", spec.lamp->x(), spec.lamp->y(),
                     surround == average_surround ? ""
                     : surround == dim_surround   ? " dim"
                                                  : " dark");
}

/// "0.1 nit (street lighting)", "0.1 nit lamp 0.5266 0.4133": menus have room for one of the two.
std::string seen_name(const LookSpec& spec) {
  const double adaptation = spec.parameters.adaptation;
  std::string name = adaptation_text(adaptation) + " nit";
  if (spec.lamp) return name + lamp_name(spec);
  for (const NamedAdaptation& step : named_adaptations)
    if (step.adaptation == adaptation) name += " (" + std::string(step.scene) + ")";
  return name;
}

}  // namespace

std::string lamp_stem(const LookSpec& spec) {
  std::string stem = lamp_name(spec);
  std::replace(stem.begin(), stem.end(), ' ', '_');
  return stem;
}

std::string night_name(const LookSpec& spec) { return "Night " + seen_name(spec); }

std::string night_file_stem(const LookSpec& spec) {
  const std::string peak = spec.night->peak == display_white ? "" : "_" + adaptation_text(spec.night->peak);
  return "night_" + spec.display + peak + "_" + adaptation_text(spec.parameters.adaptation) + lamp_stem(spec);
}

std::string look_name(const LookSpec& spec) {
  const AppearanceParameters& p = spec.parameters;
  const bool photopic = p.model != Model::safko2019 && !(p.adaptation < photopic_limit);
  std::string name = (photopic ? "Photopic " : "Mesopic ") + seen_name(spec);
  if (p.model != Model::filament2021) name += " " + std::string(name_of(p.model));
  return name;
}

std::string look_name(const AppearanceParameters& p) {
  LookSpec spec;
  spec.parameters = p;
  return look_name(spec);
}

std::string look_file_stem(const LookSpec& spec) {
  const AppearanceParameters& p = spec.parameters;
  return std::string(name_of(p.model)) + "_" + adaptation_text(p.adaptation) + lamp_stem(spec);
}

}  // namespace scotopic

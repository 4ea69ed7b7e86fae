#include "pipeline/settings.h"

#include "color/primaries.h"

namespace scotopic {

void set_primaries(OperatorChoice& choice, const ColourConfig& config) {
  AppearanceParameters& p = choice.parameters;
  p.xyz_from_rgb = config.xyz_from_working();
  p.xyz_from_gamut = choice.gamut == "working" ? p.xyz_from_rgb : gamut_xyz_matrix(choice.gamut);
}

AppearanceParameters parameters_of(const OperatorChoice& choice, double adaptation, double white_luminance) {
  AppearanceParameters out = choice.parameters;
  out.adaptation = adaptation;
  out.white_luminance = white_luminance;
  return out;
}

AppearanceParameters parameters_of(const OperatorChoice& choice, double adaptation) {
  return parameters_of(choice, adaptation, choice.white_luminance.value_or(adaptation / middle_grey));
}

void check_spaces(const ImageRequest& request, const ColourConfig& config) {
  if (request.colourspace) (void)config.resolve(*request.colourspace);
  if (request.output_colourspace) (void)config.resolve(*request.output_colourspace);
}

}  // namespace scotopic

#include "pipeline/settings.h"

#include <cstddef>

#include "base/error.h"
#include "color/primaries.h"
#include "pipeline/stages/stages.h"

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

std::optional<Lamp> lamp_of(const OperatorChoice& choice) {
  constexpr double surrounds[] = {average_surround, dim_surround, dark_surround};
  if (!choice.lamp) return std::nullopt;
  return Lamp{*choice.lamp, surrounds[static_cast<std::size_t>(choice.stages.number("surround"))]};
}

void add_stages(ImageSettings& settings) {
  for (const StageEntry& entry : settings.choice.stages.table())
    if (entry.add) entry.add(settings.choice.stages, settings);
}

EffectDecision asked_at_resolution(const StageValues& values, const StageDescription& stage, bool named,
                                   const StageScene& scene) {
  const EffectWish wish = values.wish(stage.name);
  const bool model_has_it = scene.parameters.model != Model::safko2019;
  const bool by_name = named || (wish == EffectWish::yes && model_has_it);
  if (by_name && !scene.resolution.known)
    throw Error(ExitCode::usage, "",
                std::string(stage.name) + " needs pixels per degree, which are not known: --fov or --ppd");
  EffectDecision d{.effect = stage.name};
  const bool where_known = wish == EffectWish::if_known && model_has_it;
  d.asked = by_name || (where_known && scene.resolution.known);
  d.left_out = where_known && !scene.resolution.known;
  d.reason = scene.resolution.known ? "not asked for" : "pixels per degree are not known (--ppd, --fov)";
  return d;
}

void check_spaces(const ImageRequest& request, const ColourConfig& config) {
  if (request.colourspace) (void)config.resolve(*request.colourspace);
  if (request.output_colourspace) (void)config.resolve(*request.output_colourspace);
}

}  // namespace scotopic

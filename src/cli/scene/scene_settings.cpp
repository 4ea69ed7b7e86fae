#include "cli/scene/scene_settings.h"

namespace scotopic {

SceneSettings::SceneSettings(const SceneOptions& o, int threads)
    : choice(understand(o.appearance)),
      acuity(understand(o.acuity)),
      request(understand(o.image)),
      limits(o.image.limits),
      spectral(understand(o.bands, choice.illuminant, o.image.layer)),
      config(config_in_force(o.image)) {
  check_spaces(request, config);
  set_primaries(choice, config);
  set_threads(threads);
}

Scene open_scene(const SceneSettings& settings, const std::string& input, const std::string& output,
                 const Console& console) {
  Scene scene;
  scene.source = open_input(input, settings.spectral, settings.limits, console);
  scene.layout = plan_layout(*scene.source, output, settings.config, settings.request);
  scene.known = known_numbers(settings.choice, *scene.source, scene.layout, console);
  return scene;
}

MeteredScene meter(Scene& scene, const SceneSettings& settings, bool always) {
  const OperatorChoice& choice = settings.choice;
  const bool metered_here = needs_measurement(scene.known, scene.source->file());
  const bool part = metered_here && choice.metering.region;
  const auto measured = [&](const std::optional<Window>& region) {
    return measure_image(*scene.source, scene.layout, settings.config, choice.parameters, region);
  };
  MeteredScene out;
  double adapted = 0;
  if (always) out.statistics = measured(std::nullopt);
  if (metered_here && part) {
    const SceneStatistics seen = measured(choice.metering.region);
    adapted = metered(seen, choice.metering);
    if (!always) out.statistics = seen;
  } else if (metered_here) {
    if (!out.statistics) out.statistics = measured(std::nullopt);
    adapted = metered(*out.statistics, choice.metering);
  }
  out.numbers = settle(scene.known, adapted, scene.source->file());
  return out;
}

}  // namespace scotopic

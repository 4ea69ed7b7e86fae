#include "cli/scene/scene_settings.h"

namespace scotopic {

ImageSettings understand(const SceneOptions& o) {
  OperatorChoice choice = understand(o.appearance);
  AcuityChoice acuity = understand(o.acuity);
  ImageRequest request = understand(o.image);
  SpectralOptions spectral = understand(o.bands, choice.illuminant, o.image.layer);
  ImageSettings out(config_in_force(o.image));
  check_spaces(request, out.config);
  set_primaries(choice, out.config);
  out.choice = std::move(choice);
  out.acuity = std::move(acuity);
  out.request = std::move(request);
  out.limits = o.image.limits;
  out.spectral = std::move(spectral);
  return out;
}

}  // namespace scotopic

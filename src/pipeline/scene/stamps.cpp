#include "pipeline/scene/stamps.h"

#include <cmath>
#include <string>

#include "pipeline/rows/row_codec.h"
#include "pipeline/scene/parameter_names.h"

namespace scotopic {

std::vector<Attribute> parameter_stamps(const AppearanceParameters& p, const OperatorChoice& choice,
                                        const ImageLayout& layout) {
  const bool own = has_receptors(layout.light.front().channels);
  std::vector<Attribute> stamps = {
      {"scotopic:version", std::string(SCOTOPIC_VERSION)},
      {"scotopic:model", name_in(model_names, p.model)},
      {"scotopic:adaptation", p.adaptation},
      {"scotopic:sceneWhiteLuminance", p.white_luminance},
      {"scotopic:strength", p.strength.all},
      {"scotopic:strengthShift", p.strength.shift},
      {"scotopic:strengthLuminance", p.strength.luminance},
      {"scotopic:strengthChroma", p.strength.chroma},
      {"scotopic:weight", name_in(weight_names, p.weight)},
      {"scotopic:luminance", name_in(luminance_names, p.luminance)},
      {"scotopic:gamut", choice.gamut},
      {"scotopic:rods", own ? "the file's own signals" : name_in(rod_names, p.rods)},
      {"scotopic:exposure", layout.exposure},
      {"scotopic:colorspace", layout.output_space.name},
      {"whiteLuminance", p.white_luminance / std::exp2(layout.exposure)}};
  if (!own) stamps.push_back({"scotopic:spRatio", p.sp_ratio});  // rods were estimated for that light
  if (p.model == Model::safko2019) stamps.push_back({"scotopic:safkoScale", p.safko_scale});
  return stamps;
}

void correct_stamps(std::vector<Attribute>& stamps, const DisplayChoice& choice, const ImageLayout& layout) {
  const bool device = layout.output_space.for_a_device() || layout.night;
  if (!device && !choice.tone) return;
  std::erase_if(stamps, [](const Attribute& a) { return a.name == "whiteLuminance"; });
  if (!device) stamps.push_back({"whiteLuminance", display_unit});
}

}  // namespace scotopic

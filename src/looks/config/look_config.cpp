#include "looks/config/look_config.h"

#include <sstream>

#include "color/base_config.h"
#include "base/error.h"
#include "color/config/transforms.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr const char* looks_family = "Looks";

OCIO::FileTransformRcPtr file_transform(const std::string& name, OCIO::Interpolation interpolation) {
  OCIO::FileTransformRcPtr file = OCIO::FileTransform::Create();
  file->setSrc(name.c_str());
  file->setInterpolation(interpolation);
  return file;
}

OCIO::ConstTransformRcPtr transform_of(const LookEntry& look) {
  if (look.transform) return look.transform;
  if (look.matrix) return matrix_transform(*look.matrix);
  const OCIO::FileTransformRcPtr file = file_transform(look.file, OCIO::INTERP_TETRAHEDRAL);
  if (!look.gain) return file;
  OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
  group->appendTransform(file);
  group->appendTransform(matrix_transform(diagonal<double>({*look.gain, *look.gain, *look.gain})));
  return group;
}

void add_space(OCIO::Config& config, const LookEntry& look, const LookPlace& place) {
  OCIO::LookTransformRcPtr through = OCIO::LookTransform::Create();
  through->setSrc(place.reference_space.c_str());
  through->setDst(place.process_space.c_str());
  through->setLooks(look.name.c_str());
  OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
  space->setName(look.name.c_str());
  space->setFamily(looks_family);
  space->setEncoding(place.encoding.c_str());
  for (const std::string& category : place.categories) space->addCategory(category.c_str());
  if (place.equality_groups) space->setEqualityGroup(look.name.c_str());
  space->setBitDepth(OCIO::BIT_DEPTH_F32);
  const std::string text =
      place.process_space +
      " through the look of this name; what is read from it is taken as it is, the look stays in";
  space->setDescription(text.c_str());
  space->setTransform(through, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
  // Read back as what it is: linear light that has been through the look.
  OCIO::ColorSpaceTransformRcPtr plain = OCIO::ColorSpaceTransform::Create();
  plain->setSrc(place.process_space.c_str());
  plain->setDst(place.reference_space.c_str());
  space->setTransform(plain, OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(space);
}

/// Scene light to display light by a LUT between working RGB of both.
void add_night_transform(OCIO::Config& config, const std::string& name, const NightViewEntry& night) {
  const Matrix3<double> xyz_from_ap0 = gamut_xyz_matrix("ap0").value();
  const Matrix3<double> xyz_from_rec709 = gamut_xyz_matrix("rec709").value();
  OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
  group->appendTransform(matrix_transform(inverse(xyz_from_rec709) * xyz_from_ap0));
  group->appendTransform(file_transform(night.file, OCIO::INTERP_TETRAHEDRAL));
  group->appendTransform(matrix_transform(xyz_from_rec709));
  OCIO::ViewTransformRcPtr view = OCIO::ViewTransform::Create(OCIO::REFERENCE_SPACE_SCENE);
  view->setName(name.c_str());
  view->setDescription(night.description.c_str());
  view->setTransform(group, OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE);
  config.addViewTransform(view);
}

/// The primaries that a display of the own config has, as night views name them.
std::string gamut_of(const std::string& display) {
  if (display.find("P3") != std::string::npos) return "p3";
  return display.find("2100") != std::string::npos ? "rec2020" : "rec709";
}

/// Views of a display appear in the order they are added: the night's after the plain one, raw values last.
void add_night_views(OCIO::Config& config, const std::vector<NightViewEntry>& nights) {
  for (const NightViewEntry& night : nights)
    add_night_transform(config, night.name + " " + night.gamut, night);
  for (int d = 0; d < config.getNumDisplays(); ++d) {
    const std::string display = config.getDisplay(d);
    config.removeDisplayView(display.c_str(), "Raw");
    for (const NightViewEntry& night : nights)
      if (night.gamut == gamut_of(display))
        config.addDisplayView(display.c_str(), night.name.c_str(), (night.name + " " + night.gamut).c_str(),
                              display.c_str(), "", "", night.description.c_str());
    config.addDisplayView(display.c_str(), "Raw", "Raw", "");
  }
}

}  // namespace

void add_look(OCIO::Config& config, const LookEntry& entry, const LookPlace& place) {
  OCIO::LookRcPtr look = OCIO::Look::Create();
  look->setName(entry.name.c_str());
  look->setProcessSpace(place.process_space.c_str());
  look->setDescription(entry.description.c_str());
  look->setTransform(transform_of(entry));
  if (!entry.matrix) look->setInverseTransform(matrix_transform(identity3<double>()));
  config.addLook(look);
  add_space(config, entry, place);
}

void add_noop_look(OCIO::Config& config, const std::string& name, const LookPlace& place) {
  OCIO::LookRcPtr look = OCIO::Look::Create();
  look->setName(name.c_str());
  look->setProcessSpace(place.process_space.c_str());
  look->setDescription("Changes nothing: the light-adapted eye");
  config.addLook(look);
}

LookPlace place_beside(const OCIO::Config& config, const std::string& process_space) {
  LookPlace place{process_space, reference_space(config)};
  const OCIO::ConstColorSpaceRcPtr neighbour = config.getColorSpace(process_space.c_str());
  if (*neighbour->getEncoding()) place.encoding = neighbour->getEncoding();
  place.equality_groups = *neighbour->getEqualityGroup();
  // Nothing is to be worked in behind a look.
  for (int i = 0; i < neighbour->getNumCategories(); ++i)
    if (std::string(neighbour->getCategory(i)) != "working-space")
      place.categories.emplace_back(neighbour->getCategory(i));
  return place;
}

std::string reference_space(const OCIO::Config& config) {
  for (int i = 0; i < config.getNumColorSpaces(OCIO::SEARCH_REFERENCE_SPACE_SCENE, OCIO::COLORSPACE_ALL);
       ++i) {
    const char* name =
        config.getColorSpaceNameByIndex(OCIO::SEARCH_REFERENCE_SPACE_SCENE, OCIO::COLORSPACE_ALL, i);
    const OCIO::ConstColorSpaceRcPtr space = config.getColorSpace(name);
    if (!space->isData() && !space->getTransform(OCIO::COLORSPACE_DIR_TO_REFERENCE) &&
        !space->getTransform(OCIO::COLORSPACE_DIR_FROM_REFERENCE))
      return name;
  }
  throw Error(ExitCode::config, "", "the config has no colour space that is its scene reference");
}

OCIO::ConfigRcPtr make_look_config(const std::vector<LookEntry>& looks,
                                   const std::vector<NightViewEntry>& nights,
                                   const std::string& search_path) {
  OCIO::ConfigRcPtr config = make_base_config();
  config->setSearchPath(search_path.c_str());
  config->addEnvironmentVar(context_variable, context_default);
  const LookPlace place = place_beside(*config, config->getColorSpace(OCIO::ROLE_SCENE_LINEAR)->getName());
  add_noop_look(*config, "Photopic", place);
  for (const LookEntry& look : looks) add_look(*config, look, place);
  add_night_views(*config, nights);
  return config;
}

std::string config_text(const OCIO::Config& config) {
  try {
    config.validate();
    std::ostringstream text;
    config.serialize(text);
    return text.str();
  } catch (const OCIO::Exception& e) {
    throw Error(ExitCode::config, "", std::string("the config made is not valid: ") + e.what());
  }
}

}  // namespace scotopic

#include "looks/config/ocio1_twin.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "looks/chain/chain_text.h"
#include "looks/lut/ladder.h"
#include "looks/lut/look_chain.h"
#include "looks/chain/ocio_chain.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr std::size_t edge = 17;
constexpr const char* linear = "Linear Rec.709 (sRGB)";
constexpr const char* srgb_file = "ocio1_srgb.spi1d";

OCIO::FileTransformRcPtr file_transform(const std::string& name, OCIO::Interpolation interpolation) {
  OCIO::FileTransformRcPtr file = OCIO::FileTransform::Create();
  file->setSrc(name.c_str());
  file->setInterpolation(interpolation);
  return file;
}

/// Writes a chain's tables into files, each once, and makes the transform that names them.
class Transforms {
 public:
  OCIO::GroupTransformRcPtr of(const Chain& chain, const std::string& stem) {
    OCIO::GroupTransformRcPtr group = OCIO::GroupTransform::Create();
    for (const Step& step : chain.steps) {
      if (std::holds_alternative<RangeStep>(step)) continue;
      if (const auto* table = std::get_if<Lut1DStep>(&step)) {
        group->appendTransform(file_transform(table_file(*table), OCIO::INTERP_LINEAR));
      } else if (const auto* cube = std::get_if<Lut3DStep>(&step)) {
        const std::string name = "ocio1_" + stem + ".spi3d";
        files_[name] = spi3d_text(*cube);
        group->appendTransform(file_transform(name, OCIO::INTERP_TETRAHEDRAL));
      } else {
        Chain one;
        one.steps = {step};
        group->appendTransform(ocio_transform(one)->getTransform(0)->createEditableCopy());
      }
    }
    return group;
  }

  void add(const std::string& name, const std::string& text) { files_[name] = text; }

  std::vector<TextFile> files() const {
    std::vector<TextFile> out;
    for (const auto& [name, text] : files_) out.push_back({name, text});
    return out;
  }

 private:
  /// The looks share their tables wherever these are the same.
  std::string table_file(const Lut1DStep& table) {
    const std::string text = spi1d_text(table);
    for (const auto& [name, other] : files_)
      if (other == text) return name;
    const std::string name = "ocio1_axes_" + std::to_string(++tables_) + ".spi1d";
    files_[name] = text;
    return name;
  }

  std::map<std::string, std::string> files_;
  int tables_ = 0;
};

/// IEC 61966-2-1, linear from encoded.
Lut1DStep srgb_table() {
  constexpr std::size_t length = 1024;
  Lut1DStep table{length, std::vector<double>(3 * length), 8};
  for (std::size_t i = 0; i < length; ++i) {
    const double v = static_cast<double>(i) / (length - 1);
    const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    for (std::size_t c = 0; c < 3; ++c) table.values[3 * i + c] = light;
  }
  return table;
}

void add_space(OCIO::Config& config, const char* name, const char* text,
               const OCIO::ConstTransformRcPtr& to_reference, bool data = false) {
  OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create();
  space->setName(name);
  space->setDescription(text);
  space->setBitDepth(OCIO::BIT_DEPTH_F32);
  space->setIsData(data);
  if (to_reference) space->setTransform(to_reference, OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(space);
}

OCIO::TransformRcPtr rec709_from(const char* gamut) {
  Chain chain;
  chain.steps = {
      MatrixStep{inverse(gamut_xyz_matrix("rec709").value()) * gamut_xyz_matrix(gamut).value(), {}}};
  return ocio_transform(chain)->getTransform(0)->createEditableCopy();
}

OCIO::ConfigRcPtr base_config(const std::string& search_path) {
  OCIO::ConfigRcPtr config = OCIO::Config::Create();
  config->setMajorVersion(1);
  config->setSearchPath(search_path.c_str());
  config->setDescription("Looks of the dark-adapted eye, for programs with OpenColorIO 1");
  add_space(*config, linear, "Linear light, BT.709 primaries, D65", nullptr);
  add_space(*config, "ACEScg", "Linear light, AP1 primaries", rec709_from("ap1"));
  add_space(*config, "ACES2065-1", "Linear light, AP0 primaries", rec709_from("ap0"));
  add_space(*config, "sRGB", "IEC 61966-2-1", file_transform(srgb_file, OCIO::INTERP_LINEAR));
  add_space(*config, "Raw", "Values that are not colour", nullptr, true);
  for (const char* role :
       {"scene_linear", "default", "reference", "rendering", "default_float", "compositing_linear"})
    config->setRole(role, linear);
  for (const char* role : {"color_picking", "texture_paint", "matte_paint", "default_byte",
                           "default_sequencer", "compositing_log", "color_timing"})
    config->setRole(role, "sRGB");
  config->setRole("data", "Raw");
  config->setRole("aces_interchange", "ACES2065-1");
  config->addDisplayView("sRGB", "Un-tone-mapped", "sRGB", "");
  config->addDisplayView("sRGB", "Raw", "Raw", "");
  return config;
}

}  // namespace

Ocio1Twin make_ocio1_twin(const std::vector<LookSpec>& specs, const std::string& search_path) {
  Transforms transforms;
  transforms.add(srgb_file, spi1d_text(srgb_table()));
  const OCIO::ConfigRcPtr config = base_config(search_path);
  const LookPlace place = {linear, linear};
  add_noop_look(*config, "Photopic", place);
  for (const LookSpec& spec : specs) {
    if (is_identity(spec.parameters) || spec.parameters.model != specs.front().parameters.model) continue;
    LookEntry entry;
    entry.name = look_name(spec.parameters);
    entry.description = "Adapted to " + adaptation_text(spec.parameters.adaptation) + " cd/m2. Forward only";
    entry.transform = transforms.of(look_chain(spec.parameters, edge), look_file_stem(spec.parameters));
    add_look(*config, entry, place);
    config->addDisplayView("sRGB", entry.name.c_str(), "sRGB", entry.name.c_str());
  }
  return {config_text(*config), transforms.files()};
}

}  // namespace scotopic

#include "color/base_config.h"

#include <string>
#include <vector>

#include "color/config/camera_spaces.h"
#include "color/config/transforms.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

struct Description {
  const char* name;
  std::vector<const char*> aliases;
  const char* family;
  const char* encoding;
  const char* text;
};

OCIO::ColorSpaceRcPtr make_space(OCIO::ReferenceSpaceType reference, const Description& d) {
  OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(reference);
  space->setName(d.name);
  for (const char* alias : d.aliases) space->addAlias(alias);
  space->setFamily(d.family);
  space->setEncoding(d.encoding);
  space->setDescription(d.text);
  space->setBitDepth(OCIO::BIT_DEPTH_F32);
  return space;
}

Matrix3<double> xyz_of(std::string_view gamut) { return gamut_xyz_matrix(gamut).value(); }

/// ACES2065-1 from the linear RGB of a gamut, both D65-adapted on the way.
Matrix3<double> ap0_from(std::string_view gamut) { return inverse(xyz_of("ap0")) * xyz_of(gamut); }

/// IEC 61966-2-1: linear from encoded, or (inverse) encoded from linear; mirrored below 0 for displays.
OCIO::ExponentWithLinearTransformRcPtr srgb_curve(OCIO::TransformDirection direction,
                                                  OCIO::NegativeStyle style) {
  const double gamma[4] = {2.4, 2.4, 2.4, 1.0};
  const double offset[4] = {.055, .055, .055, 0.0};
  OCIO::ExponentWithLinearTransformRcPtr curve = OCIO::ExponentWithLinearTransform::Create();
  curve->setGamma(gamma);
  curve->setOffset(offset);
  curve->setNegativeStyle(style);
  curve->setDirection(direction);
  return curve;
}

/// ITU-R BT.1886 with zero black: a pure power of 2.4, encoded from linear.
OCIO::ExponentTransformRcPtr bt1886_curve() {
  const double gamma[4] = {2.4, 2.4, 2.4, 1.0};
  OCIO::ExponentTransformRcPtr curve = OCIO::ExponentTransform::Create();
  curve->setValue(gamma);
  curve->setNegativeStyle(OCIO::NEGATIVE_MIRROR);
  curve->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
  return curve;
}

void add_linear_space(OCIO::Config& config, const Description& d, std::string_view gamut) {
  OCIO::ColorSpaceRcPtr space = make_space(OCIO::REFERENCE_SPACE_SCENE, d);
  if (gamut != "ap0")
    space->setTransform(matrix_transform(ap0_from(gamut)), OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(space);
}

void add_scene_spaces(OCIO::Config& config) {
  add_linear_space(config,
                   {"Linear Rec.709 (sRGB)",
                    {"Linear", "lin_rec709", "lin_srgb", "lin_rec709_srgb", "lin_rec709_scene"},
                    "Scene",
                    "scene-linear",
                    "Linear light, ITU-R BT.709 primaries, D65"},
                   "rec709");
  add_linear_space(config,
                   {"ACES2065-1",
                    {"aces2065_1", "lin_ap0", "ACES - ACES2065-1", "lin_ap0_scene"},
                    "ACES",
                    "scene-linear",
                    "SMPTE ST 2065-1"},
                   "ap0");
  add_linear_space(
      config,
      {"ACEScg", {"lin_ap1", "ACES - ACEScg", "lin_ap1_scene"}, "ACES", "scene-linear", "AMPAS S-2014-004"},
      "ap1");
  add_linear_space(config,
                   {"Linear Rec.2020",
                    {"lin_rec2020", "lin_rec2020_scene"},
                    "Scene",
                    "scene-linear",
                    "Linear light, ITU-R BT.2020 primaries, D65"},
                   "rec2020");
  add_linear_space(config,
                   {"Linear P3-D65",
                    {"lin_p3d65", "lin_p3d65_scene"},
                    "Scene",
                    "scene-linear",
                    "Linear light, P3 primaries, D65"},
                   "p3");

  OCIO::ColorSpaceRcPtr xyz = make_space(
      OCIO::REFERENCE_SPACE_SCENE, {"CIE XYZ-D65",
                                    {"lin_cie_xyz_d65", "lin_ciexyzd65_scene"},
                                    "Scene",
                                    "scene-linear",
                                    "CIE 1931 XYZ of the scene, adapted to D65 (Bradford); white has Y = 1"});
  xyz->setTransform(matrix_transform(inverse(xyz_of("ap0"))), OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(xyz);

  add_camera_spaces(config);

  OCIO::ColorSpaceRcPtr texture =
      make_space(OCIO::REFERENCE_SPACE_SCENE, {"sRGB - Texture",
                                               {"srgb_texture", "srgb_tx", "srgb_rec709_scene"},
                                               "Texture",
                                               "sdr-video",
                                               "Scene light encoded with the curve of IEC 61966-2-1"});
  texture->setTransform(group_of(srgb_curve(OCIO::TRANSFORM_DIR_FORWARD, OCIO::NEGATIVE_LINEAR),
                                 matrix_transform(ap0_from("rec709"))),
                        OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config.addColorSpace(texture);

  OCIO::ColorSpaceRcPtr raw = make_space(
      OCIO::REFERENCE_SPACE_SCENE, {"Raw", {"Non-Color"}, "Utility", "data", "Values that are not colour"});
  raw->setIsData(true);
  config.addColorSpace(raw);
}

void add_display(OCIO::Config& config, const Description& d, const OCIO::ConstTransformRcPtr& from_xyz) {
  OCIO::ColorSpaceRcPtr space = make_space(OCIO::REFERENCE_SPACE_DISPLAY, d);
  space->setTransform(from_xyz, OCIO::COLORSPACE_DIR_FROM_REFERENCE);
  config.addColorSpace(space);
  config.addDisplayView(d.name, "Un-tone-mapped", "Un-tone-mapped", d.name, "", "", "");
  config.addDisplayView(d.name, "Raw", "Raw", "");
}

void add_displays(OCIO::Config& config) {
  OCIO::ViewTransformRcPtr view = OCIO::ViewTransform::Create(OCIO::REFERENCE_SPACE_SCENE);
  view->setName("Un-tone-mapped");
  view->setDescription("Scene light shown as it is, white at Y = 1");
  view->setTransform(matrix_transform(xyz_of("ap0")), OCIO::VIEWTRANSFORM_DIR_FROM_REFERENCE);
  config.addViewTransform(view);
  config.setDefaultViewTransformName("Un-tone-mapped");

  config.addColorSpace(make_space(
      OCIO::REFERENCE_SPACE_DISPLAY,
      {"CIE-XYZ-D65", {"cie_xyz_d65"}, "Display", "display-linear", "CIE 1931 XYZ of the display, D65"}));
  const auto encoded_by_srgb = [](std::string_view gamut) {
    return group_of(matrix_transform(inverse(xyz_of(gamut))),
                    srgb_curve(OCIO::TRANSFORM_DIR_INVERSE, OCIO::NEGATIVE_MIRROR));
  };
  add_display(config,
              {"sRGB - Display",
               {"sRGB", "srgb_display", "srgb_rec709_display"},
               "Display",
               "sdr-video",
               "IEC 61966-2-1"},
              encoded_by_srgb("rec709"));
  add_display(config,
              {"Display P3 - Display",
               {"displayp3_display", "srgb_p3d65_display"},
               "Display",
               "sdr-video",
               "P3, D65, curve of sRGB"},
              encoded_by_srgb("p3"));
  add_display(config,
              {"Rec.1886 Rec.709 - Display",
               {"rec1886_rec709_display", "g24_rec709_display"},
               "Display",
               "sdr-video",
               "ITU-R BT.1886, BT.709 primaries"},
              group_of(matrix_transform(inverse(xyz_of("rec709"))), bt1886_curve()));
  OCIO::BuiltinTransformRcPtr pq = OCIO::BuiltinTransform::Create();
  pq->setStyle("DISPLAY - CIE-XYZ-D65_to_REC.2100-PQ");
  add_display(
      config,
      {"Rec.2100-PQ - Display",
       {"rec2100_pq_display"},
       "Display",
       "hdr-video",
       "ITU-R BT.2100, PQ; 1 of a display's light is 100 cd/m2, views are made for a peak of 1000 cd/m2"},
      pq);
  OCIO::BuiltinTransformRcPtr hlg = OCIO::BuiltinTransform::Create();
  hlg->setStyle("DISPLAY - CIE-XYZ-D65_to_REC.2100-HLG-1000nit");
  add_display(config,
              {"Rec.2100-HLG - Display",
               {"rec2100_hlg_display"},
               "Display",
               "hdr-video",
               "ITU-R BT.2100, HLG on a display of 1000 cd/m2; 1 of a display's light is 100 cd/m2"},
              hlg);
}

void add_roles(OCIO::Config& config) {
  const char* linear = "Linear Rec.709 (sRGB)";
  const char* texture = "sRGB - Texture";
  // Blender ends itself where one of its own roles is missing.
  for (const char* role : {"scene_linear", "default", "reference", "rendering", "default_float"})
    config.setRole(role, linear);
  for (const char* role :
       {"color_picking", "texture_paint", "matte_paint", "default_byte", "default_sequencer"})
    config.setRole(role, texture);
  for (const char* role : {"compositing_log", "color_timing"}) config.setRole(role, "ACEScct");
  config.setRole("data", "Raw");
  config.setRole("aces_interchange", "ACES2065-1");
  config.setRole("cie_xyz_d65_interchange", "CIE-XYZ-D65");
}

void add_file_rules(OCIO::Config& config) {
  OCIO::FileRulesRcPtr rules = OCIO::FileRules::Create();
  std::size_t position = 0;
  for (const char* extension : {"[pP][nN][gG]", "[jJ][pP][gG]", "[jJ][pP][eE][gG]"}) {
    const std::string name = "display-encoded " + std::to_string(position + 1);
    rules->insertRule(position++, name.c_str(), "sRGB - Texture", "*", extension);
  }
  rules->setDefaultRuleColorSpace("default");
  config.setFileRules(rules);
}

}  // namespace

OCIO::ConfigRcPtr make_base_config() {
  OCIO::ConfigRcPtr config = OCIO::Config::Create();
  config->setMajorVersion(2);
  config->setMinorVersion(0);
  config->setName("scotopic");
  config->setDescription(
      "Colour spaces of the ACES configs; looks that show a scene as the dark-adapted eye sees it");
  config->setStrictParsingEnabled(true);
  const double luma[3] = {xyz_of("rec709")[1][0], xyz_of("rec709")[1][1], xyz_of("rec709")[1][2]};
  config->setDefaultLumaCoefs(luma);
  add_scene_spaces(*config);
  add_displays(*config);
  add_roles(*config);
  add_file_rules(*config);
  return config;
}

}  // namespace scotopic

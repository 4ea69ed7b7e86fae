#include "color/colour_config.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "color/base_config.h"
#include "base/error.h"
#include "base/names.h"

namespace scotopic {
namespace {

namespace OCIO = OCIO_NAMESPACE;

std::string saved_config(const OCIO::ConstConfigRcPtr& config, const std::string& name) {
  const std::string file = ::testing::TempDir() + "/" + std::to_string(getpid()) + name;
  std::ofstream stream(file);
  config->serialize(stream);
  return file;
}

TEST(BaseConfig, is_valid_and_of_version_two_with_every_role_that_hosts_ask_for) {
  const OCIO::ConstConfigRcPtr config = make_base_config();
  EXPECT_NO_THROW(config->validate());
  EXPECT_EQ(config->getMajorVersion(), 2u);
  EXPECT_EQ(config->getMinorVersion(), 0u);
  for (const char* role :
       {"scene_linear", "default", "data", "reference", "rendering", "color_picking", "texture_paint",
        "matte_paint", "compositing_log", "color_timing", "default_byte", "default_float",
        "default_sequencer", "aces_interchange", "cie_xyz_d65_interchange"})
    EXPECT_TRUE(config->hasRole(role)) << role;
  for (const char* name : {"Linear", "linear", "sRGB", "ACES2065-1", "ACEScg", "Linear Rec.709 (sRGB)",
                           "sRGB - Display", "Raw", "CIE XYZ-D65", "lin_rec709"})
    EXPECT_NE(config->getColorSpace(name), nullptr) << name;
}

TEST(BaseConfig, survives_being_written_and_read) {
  const ColourConfig read = ColourConfig::from_file(saved_config(make_base_config(), "base.ocio"));
  EXPECT_EQ(read.working_space(), "Linear Rec.709 (sRGB)");
  EXPECT_EQ(read.working_gamut(), "rec709");
}

TEST(ColourConfig, white_of_the_working_space_has_luminance_one) {
  const ColourConfig config = ColourConfig::own();
  const Vec3<double> white = config.xyz_from_working() * Vec3<double>{1, 1, 1};
  EXPECT_NEAR(white[1], 1.0, 4e-16);
}

TEST(ColourConfig, any_scene_linear_space_is_found_as_xyz) {
  for (const NamedPrimaries& set : known_primaries()) {
    const OCIO::ConfigRcPtr config = make_base_config();
    config->setRole("scene_linear", std::string(set.label).c_str());
    const ColourConfig found = ColourConfig::from_file(saved_config(config, "working.ocio"));
    EXPECT_EQ(found.working_gamut(), set.name);
  }
}

TEST(ColourConfig, an_active_display_that_is_not_there_is_no_reason_to_refuse_the_rest) {
  const OCIO::ConfigRcPtr config = make_base_config();
  config->setActiveDisplays("None, srgb - display");
  EXPECT_THROW(config->validate(), OCIO::Exception);
  const ColourConfig read = ColourConfig::from_file(saved_config(config, "active.ocio"));
  EXPECT_EQ(read.ocio()->getNumDisplays(), 1);
  config->setActiveDisplays("None");
  EXPECT_THROW((void)ColourConfig::from_file(saved_config(config, "none.ocio")), Error);
}

TEST(ColourConfig, xyz_is_found_by_whichever_interchange_the_config_has) {
  const OCIO::ConfigRcPtr config = make_base_config();
  config->setRole("aces_interchange", nullptr);
  EXPECT_EQ(ColourConfig::from_file(saved_config(config, "xyz.ocio")).working_gamut(), "rec709");
}

// As Blender 5 has it: scene_linear is defined through the display-referred XYZ, and a tone map through
// scene_linear. Only the default view transform lies between the two references.
TEST(ColourConfig, a_view_transform_may_lead_through_the_space_that_is_defined_by_another_one) {
  const std::string file = ::testing::TempDir() + "/views" + std::to_string(getpid()) + ".ocio";
  const auto write = [&](const std::string& plain) {
    std::ofstream(file) << R"(ocio_profile_version: 2
roles: {scene_linear: Lin, default: Lin, aces_interchange: Ref, cie_xyz_d65_interchange: XYZ}
file_rules:
  - !<Rule> {name: Default, colorspace: default}
displays:
  Screen:
    - !<View> {name: Toned, view_transform: Toned, display_colorspace: Screen}
    - !<View> {name: Plain, view_transform: Plain, display_colorspace: Screen}
default_view_transform: Plain
view_transforms:
  - !<ViewTransform>
    name: Plain
    from_scene_reference: )"
                        << plain << R"(
  - !<ViewTransform>
    name: Toned
    from_scene_reference: !<GroupTransform>
      children:
        - !<ColorSpaceTransform> {src: Ref, dst: Lin}
        - !<ExponentTransform> {value: 1.2}
        - !<ColorSpaceTransform> {src: Lin, dst: XYZ}
display_colorspaces:
  - !<ColorSpace> {name: XYZ}
  - !<ColorSpace>
    name: Screen
    from_display_reference: !<ExponentTransform> {value: 2.2, direction: inverse}
colorspaces:
  - !<ColorSpace> {name: Ref}
  - !<ColorSpace>
    name: Lin
    from_scene_reference: !<GroupTransform>
      children:
        - !<ColorSpaceTransform> {src: Ref, dst: XYZ}
        - !<MatrixTransform> {matrix: [3.24, -1.54, -0.5, 0, -0.97, 1.88, 0.04, 0, 0.06, -0.2, 1.06, 0, 0, 0, 0, 1]}
)";
  };
  write("!<MatrixTransform> {matrix: [0.94, 0, 0.01, 0, 0.34, 0.73, -0.07, 0, 0, 0, 1.09, 0, 0, 0, 0, 1]}");
  EXPECT_NO_THROW((void)ColourConfig::from_file(file));
  write("!<ColorSpaceTransform> {src: Ref, dst: XYZ}");  // this one does lead to itself
  EXPECT_THROW((void)ColourConfig::from_file(file), Error);
}

TEST(ColourConfig, a_tone_map_on_the_way_to_the_display_is_not_taken_for_a_matrix) {
  const OCIO::ConfigRcPtr config = OCIO::Config::CreateRaw()->createEditableCopy();
  config->setMajorVersion(2);
  OCIO::ColorSpaceRcPtr encoded = OCIO::ColorSpace::Create();
  encoded->setName("XYZ");
  OCIO::ExponentTransformRcPtr gamma = OCIO::ExponentTransform::Create();
  const double power[4] = {2.2, 2.2, 2.2, 1};
  gamma->setValue(power);
  encoded->setTransform(gamma, OCIO::COLORSPACE_DIR_TO_REFERENCE);
  config->addColorSpace(encoded);
  OCIO::ColorSpaceRcPtr linear = OCIO::ColorSpace::Create();
  linear->setName("lin");
  config->addColorSpace(linear);
  config->setRole("scene_linear", "lin");
  try {
    ColourConfig::from_file(saved_config(config, "tone.ocio"));
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::config);
    EXPECT_NE(std::string(e.what()).find("aces_interchange"), std::string::npos) << e.what();
  }
}

TEST(ColourConfig, conversions_come_back) {
  const ColourConfig config = ColourConfig::own();
  double worst = 0;
  std::string where;
  for (const char* name :
       {"ACES2065-1", "ACEScg", "sRGB - Texture", "sRGB - Display", "CIE XYZ-D65", "ACEScct", "Linear P3-D65",
        "Display P3 - Display", "Rec.1886 Rec.709 - Display"}) {
    float r[3] = {.18f, 1.0f, .01f}, g[3] = {.5f, 1.0f, .02f}, b[3] = {.03f, 1.0f, .7f};
    config.from_working(config.space(name)).apply(r, g, b, 3);
    config.to_working(config.space(name)).apply(r, g, b, 3);
    const float expected[3][3] = {{.18f, 1.0f, .01f}, {.5f, 1.0f, .02f}, {.03f, 1.0f, .7f}};
    const float* got[3] = {r, g, b};
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) {
        const double error = std::abs(static_cast<double>(got[c][i]) - static_cast<double>(expected[c][i]));
        if (error > worst) worst = error, where = name;
      }
  }
  std::printf("worst round trip %.2g in %s\n", worst, where.c_str());
  EXPECT_LE(worst, 4e-6);  // OCIO computes in float: 8 ulp of 1, through log and power
}

TEST(ColourConfig, the_working_space_under_any_name_is_no_conversion) {
  const ColourConfig config = ColourConfig::own();
  for (const char* name : {"scene_linear", "Linear", "lin_srgb", "Linear Rec.709 (sRGB)"})
    EXPECT_TRUE(config.to_working(config.space(name)).identity()) << name;
  const ColourSpace stated{"stated", gamut_xyz_matrix("rec709")};
  EXPECT_TRUE(config.to_working(stated).identity());
  EXPECT_TRUE(config.same(stated, config.space("Linear")));
  EXPECT_FALSE(config.same(stated, config.space("ACEScg")));
}

TEST(ColourConfig, integers_are_display_encoded_and_floats_scene_linear) {
  const ColourConfig config = ColourConfig::own();
  EXPECT_EQ(config.space_of_file("a.png", true).name, "sRGB - Texture");
  EXPECT_EQ(config.space_of_file("a.JPG", true).name, "sRGB - Texture");
  EXPECT_EQ(config.space_of_file("a.tif", true).name, "sRGB - Texture");
  EXPECT_EQ(config.space_of_file("a.tif", false).name, config.working_space());
  EXPECT_EQ(config.space_of_file("a.exr", false).name, config.working_space());
  EXPECT_TRUE(config.is_srgb(config.space("sRGB - Texture")));
  EXPECT_TRUE(config.is_srgb(config.space("sRGB - Display")));
  EXPECT_FALSE(config.is_srgb(config.space("Linear")));
}

TEST(ColourConfig, an_unknown_space_is_an_error_that_names_close_ones) {
  const ColourConfig config = ColourConfig::own();
  try {
    config.resolve("ACESg");
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::config);
    EXPECT_NE(std::string(e.what()).find("ACEScg"), std::string::npos) << e.what();
  }
}

TEST(Names, close_ones_come_first_and_far_ones_not_at_all) {
  const std::vector<std::string> names = {"linear", "quadratic", "Linear Rec.709 (sRGB)"};
  EXPECT_EQ(close_names("linaer", names).front(), "linear");
  EXPECT_EQ(close_names("rec.709", names).front(), "Linear Rec.709 (sRGB)");
  EXPECT_TRUE(close_names("xyzzy", names).empty());
  EXPECT_TRUE(close_names("", names).empty());
}

}  // namespace
}  // namespace scotopic

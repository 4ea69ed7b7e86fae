// The project's own config with looks.
#include <gtest/gtest.h>

#include <cmath>

#include <algorithm>
#include <set>
#include <sstream>

#include "looks/config/manifest.h"
#include "looks/config/own_mark.h"
#include "looks/verify/inspect.h"
#include "looks/lut/shipped_looks.h"
#include "looks/config/look_set.h"
#include "looks/chain/ocio_chain.h"
#include "adaptation/thresholds.h"
#include "looks/support.h"
#include "looks/verify/measure.h"
#include "base/error.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

LookSpec spec_at(double adaptation, const ColourConfig& config) {
  LookSpec spec;
  spec.parameters = test::adapted_to(adaptation);
  spec.parameters.xyz_from_rgb = config.xyz_from_working();
  spec.parameters.xyz_from_gamut = config.xyz_from_working();
  spec.space = config.working_space();
  spec.edge = 17;
  return spec;
}

/// A config of two looks in a folder of its own, written as the program does.
class OwnConfig : public testing::Test {
 protected:
  void SetUp() override {
    const ColourConfig own = ColourConfig::own();
    const std::vector<LookSpec> specs = {spec_at(10, own), spec_at(0.1, own), spec_at(0.01, own)};
    set_ = bake_set(specs, own, "test", true);
    add_nights(set_, specs, own, "test");
    for (const TextFile& lut : set_.luts) folder_.write("luts/" + lut.name, lut.text);
    folder_.write("luts/MANIFEST", manifest_text(set_, "test", "bake"));
    text_ = look_config_text(set_);
    config_ = OCIO::Config::CreateFromFile(folder_.write("config.ocio", text_).c_str());
  }

  std::array<float, 4> through(const OCIO::ConstTransformRcPtr& transform) const {
    std::array<float, 4> pixel = {0.02f, 0.05f, 0.2f, 0.25f};
    config_->getProcessor(transform)->getDefaultCPUProcessor()->applyRGBA(pixel.data());
    return pixel;
  }

  test::Folder folder_;
  LookSet set_;
  std::string text_;
  OCIO::ConstConfigRcPtr config_;
};

constexpr const char* street = "Mesopic 0.1 nit (street lighting)";
constexpr const char* night = "Night 0.1 nit (street lighting)";
constexpr const char* linear = "Linear Rec.709 (sRGB)";

OCIO::LookTransformRcPtr look_transform(const char* look) {
  OCIO::LookTransformRcPtr transform = OCIO::LookTransform::Create();
  transform->setSrc(linear);
  transform->setDst(linear);
  transform->setLooks(look);
  return transform;
}

TEST_F(OwnConfig, is_valid_and_of_the_profile_that_debian_s_ocio_reads) {
  EXPECT_NO_THROW(config_->validate());
  EXPECT_EQ(config_->getMajorVersion(), 2u);
  EXPECT_EQ(config_->getMinorVersion(), 0u);
  EXPECT_EQ(text_.find("${"), std::string::npos);
}

TEST_F(OwnConfig, first_look_changes_nothing) {
  EXPECT_STREQ(config_->getLookNameByIndex(0), "Photopic");
  EXPECT_TRUE(config_->getProcessor(look_transform("Photopic"))->isNoOp());
}

TEST_F(OwnConfig, a_look_is_the_same_as_look_and_as_space) {
  const auto as_look = through(look_transform(street));
  OCIO::ColorSpaceTransformRcPtr space = OCIO::ColorSpaceTransform::Create();
  space->setSrc(linear);
  space->setDst(street);
  const auto as_space = through(space);
  EXPECT_NE(as_look[2], 0.2f);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(as_space[c], as_look[c], 2e-6f) << c;
  EXPECT_EQ(as_look[3], 0.25f);
}

TEST_F(OwnConfig, every_display_offers_one_row_of_night_views) {
  ASSERT_EQ(config_->getNumDisplays(), 5);
  for (int d = 0; d < 5; ++d) {
    std::vector<std::string> views;
    for (int v = 0; v < config_->getNumViews(config_->getDisplay(d)); ++v)
      views.emplace_back(config_->getView(config_->getDisplay(d), v));
    EXPECT_EQ(views, (std::vector<std::string>{"Un-tone-mapped", "Night 10 nit (lamplit room)", night,
                                               "Night 0.01 nit (full moon)", "Raw"}))
        << config_->getDisplay(d);
  }
}

/// Linear light of a display, in working RGB, that a view shows of the pixel.
Vec3<double> shown(const OCIO::ConstConfigRcPtr& config, const char* display, const char* view,
                   Vec3<float> pixel) {
  OCIO::DisplayViewTransformRcPtr transform = OCIO::DisplayViewTransform::Create();
  transform->setSrc(linear);
  transform->setDisplay(display);
  transform->setView(view);
  OCIO::ColorSpaceTransformRcPtr back = OCIO::ColorSpaceTransform::Create();
  back->setSrc(display);
  back->setDst(linear);
  OCIO::GroupTransformRcPtr both = OCIO::GroupTransform::Create();
  both->appendTransform(transform);
  both->appendTransform(back);
  config->getProcessor(both)->getDefaultCPUProcessor()->applyRGB(pixel.data());
  return {pixel[0], pixel[1], pixel[2]};
}

TEST_F(OwnConfig, a_night_view_is_the_operator_and_the_display_stage) {
  struct Row {
    const char *display, *gamut;
    double peak, tolerance;  // of the peak: 17 nodes a side
  };
  for (const Row& row :
       {Row{"sRGB - Display", "rec709", 100, 0.03}, Row{"Rec.1886 Rec.709 - Display", "rec709", 100, 0.03},
        Row{"Display P3 - Display", "p3", 100, 0.03}, Row{"Rec.2100-PQ - Display", "rec2020", 1000, 0.06},
        Row{"Rec.2100-HLG - Display", "rec2020", 1000, 0.06}})
    for (const Vec3<float>& pixel :
         {Vec3<float>{0.02f, 0.05f, 0.2f}, {0.18f, 0.18f, 0.18f}, {60, 2, 0.5f}, {3000, 2000, 900}}) {
      AppearanceParameters p = test::adapted_to(0.1);
      NightDisplayParameters d;
      d.peak = row.peak;
      d.xyz_from_display = gamut_xyz_matrix(row.gamut).value();
      const Colours expected = exact_night(p, d, {{pixel[0]}, {pixel[1]}, {pixel[2]}});
      const Vec3<double> seen = shown(config_, row.display, night, pixel);
      const double peaks = row.peak / 100;
      for (const auto& [got, wanted] : {std::pair(seen[0], expected.r[0]), std::pair(seen[1], expected.g[0]),
                                        std::pair(seen[2], expected.b[0])})
        EXPECT_NEAR(got / peaks, wanted, row.tolerance) << row.display << " " << pixel[0];
    }
}

TEST_F(OwnConfig, a_night_look_is_the_look_as_dark_as_the_eye_sees_it) {
  const auto look = through(look_transform(street)), dimmed = through(look_transform(night));
  const double gain = std::exp2(visibility_stops(0.1, VisibilityRule::hdrvdp2));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(dimmed[c], gain * static_cast<double>(look[c]), 1e-6) << c;
}

TEST_F(OwnConfig, the_context_variable_chooses_the_luminance) {
  const auto with = [&](const char* value) {
    const OCIO::ContextRcPtr context = config_->getCurrentContext()->createEditableCopy();
    if (value) context->setStringVar("SCOTOPIC_LA", value);
    float pixel[3] = {0.02f, 0.05f, 0.2f};
    config_->getProcessor(context, look_transform("Mesopic by SCOTOPIC_LA"), OCIO::TRANSFORM_DIR_FORWARD)
        ->getDefaultCPUProcessor()
        ->applyRGB(pixel);
    return pixel[2];
  };
  const auto fixed = [&](const char* look) { return through(look_transform(look))[2]; };
  EXPECT_EQ(with(nullptr), fixed(street));
  EXPECT_EQ(with("0.01"), fixed("Mesopic 0.01 nit (full moon)"));
  EXPECT_EQ(with("10"), 0.2f);
  EXPECT_THROW((void)with("0.0123"), OCIO::Exception);
}

TEST_F(OwnConfig, matrix_looks_are_the_operator_s_chroma_with_global_weight) {
  AppearanceParameters p = test::adapted_to(0.1);
  p.weight = Weight::global;
  p.strength.shift = p.strength.luminance = 0;
  const auto processor = cpu_processor(look_transform("Chroma 0.1 nit (global weight matrix)"), config_);
  const BakeError e = measure_bake(p, processor, p.xyz_from_rgb, 20000);
  std::printf("matrix look: mean %.2g max %.2g\n", e.mean, e.max);
  EXPECT_LE(e.max, 0.005);
}

TEST(OwnMark, a_config_counts_as_written_by_bake_until_a_byte_of_it_changes) {
  const std::string text = marked("a: 1\nb: 2\n", "1.0");
  EXPECT_EQ(text.substr(text.find('\n') + 1), "a: 1\nb: 2\n");
  EXPECT_TRUE(is_as_marked(text));
  EXPECT_TRUE(is_as_marked(marked("", "1.0")));
  for (const std::string& other : {std::string(), std::string("a: 1\n"), text + "\n", text.substr(1),
                                   text.substr(0, text.size() - 1), text.substr(0, text.find('\n'))})
    EXPECT_FALSE(is_as_marked(other)) << other;
}

TEST(Manifest, one_more_set_of_files_is_listed_beside_what_was) {
  const std::string a(64, 'a'), b(64, 'b'), c(64, 'c');
  const std::string older =
      "# Made by scotopic 1: x\n# Check with: y\n# one\n" + a + "  1.clf\n# two\n" + b + "  2.clf\n";
  const std::string fresh = "# Made by scotopic 1: z\n# two again\n" + c + "  2.clf\n";
  EXPECT_EQ(merged_manifest(older, fresh),
            "# Made by scotopic 1: x\n# Check with: y\n# one\n" + a + "  1.clf\n" + fresh);
  EXPECT_EQ(merged_manifest("", fresh), fresh);
  EXPECT_EQ(merged_manifest(fresh, fresh), "# Made by scotopic 1: z\n" + fresh);
}

TEST_F(OwnConfig, inspection_finds_it_sound_and_finds_what_is_not) {
  const ColourConfig config = ColourConfig::from_file(folder_.path("config.ocio"));
  const std::vector<Inspected> looks = inspect_config(config, street);
  ASSERT_EQ(looks.size(), 1u);
  EXPECT_TRUE(looks[0].problems.empty()) << looks[0].problems[0];
  EXPECT_THROW((void)inspect_config(config, "Mesopic 7 nit"), Error);
  EXPECT_TRUE(manifest_problems(folder_.path("luts")).empty());
  // Seven of the ladder's files are not there, which the context look will hit one day.
  const std::vector<Inspected> context = inspect_config(config, "Mesopic by SCOTOPIC_LA");
  EXPECT_EQ(context.at(0).problems.size(), 6u);

  const std::string lut = "luts/" + set_.luts[1].name;
  folder_.write(lut, set_.luts[1].text + "\n");
  folder_.write("luts/stray.clf", "x");
  EXPECT_EQ(manifest_problems(folder_.path("luts")).size(), 2u);
  std::filesystem::remove(folder_.path(lut));
  EXPECT_EQ(manifest_problems(folder_.path("luts")).size(), 2u);
}

}  // namespace
}  // namespace scotopic

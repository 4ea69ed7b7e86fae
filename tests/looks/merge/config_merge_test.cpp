// A studio's config that gets looks: nothing of it is lost, and every way that was added is there.
#include "looks/merge/config_merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>

#include "base/error.h"
#include "color/primaries.h"
#include "looks/merge/configs.h"
#include "looks/merge/line_diff.h"
#include "looks/support.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr const char* street = "Mesopic 0.1 nit (street lighting)";
const std::optional<Matrix3<double>> rec709 = gamut_xyz_matrix("rec709");

/// One look, as baked for the config, and a matrix.
LookSet looks_for(const ColourConfig& config) {
  LookSpec spec;
  spec.parameters = test::adapted_to(0.1);
  spec.parameters.xyz_from_rgb = config.xyz_from_working();
  spec.parameters.xyz_from_gamut = config.xyz_from_working();
  spec.space = config.working_space();
  spec.edge = 17;
  return bake_set({spec}, config, "test", false);
}

struct Kind {
  const char* name;
  const char* text;
  std::optional<Matrix3<double>> working;
  const char* search_path;            ///< of the result
  const char* lut_folder;             ///< within the config's
  std::vector<std::string> displays;  ///< that get the view
  std::set<std::string> changed;      ///< lines of the original that may go, by what they begin with
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"studio",
       test::studio,
       {},
       "luts:shared/luts",
       "luts/scotopic",
       {"monitor", "wall 2"},
       {"active_views"}},
      {"aces",
       test::aces,
       {},
       ".",
       "scotopic",
       {"sRGB - Display", "P3-D65 - Display", "PQ - Display"},
       {"active_views", "search_path", "    - !<Views> [SDR, Un-tone-mapped]"}},
      {"no_interchange",
       test::no_interchange,
       rec709,
       "LUTs",
       "LUTs/scotopic",
       {"sRGB", "Broken"},
       {"looks: []"}},
      {"profile_1", test::profile_1, rec709, ".", "scotopic", {"sRGB"}, {}}};
  return all;
}

class EveryKind : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    file_ = folder_.write("config.ocio", GetParam().text);
    config_ = std::make_unique<ColourConfig>(ColourConfig::from_file(file_, {}, GetParam().working));
    set_ = looks_for(*config_);
    merged_ = merge_looks(*config_, set_.entries);
  }

  /// As a host has it: config and LUTs where they are to be.
  OCIO::ConstConfigRcPtr written() const {
    for (const TextFile& lut : set_.luts)
      folder_.write(std::filesystem::relative(merged_.lut_folder, folder_.path()).string() + "/" + lut.name,
                    lut.text);
    folder_.write("config.ocio", merged_.text);
    return OCIO::Config::CreateFromFile(file_.c_str());
  }

  test::Folder folder_;
  std::string file_;
  std::unique_ptr<ColourConfig> config_;
  LookSet set_;
  MergedConfig merged_;
};

TEST_P(EveryKind, no_line_is_lost_but_those_that_get_longer) {
  EXPECT_FALSE(merged_.rewritten);
  std::istringstream diff(line_diff(GetParam().text, merged_.text));
  for (std::string line; std::getline(diff, line);) {
    if (line.empty() || line[0] != '-') continue;
    const auto& changed = GetParam().changed;
    EXPECT_TRUE(std::any_of(changed.begin(), changed.end(), [&](const std::string& c) {
      return line.compare(1, c.size(), c) == 0;
    })) << line;
  }
}

TEST_P(EveryKind, look_space_and_views_load_and_are_offered) {
  EXPECT_NO_THROW(require_all_load(merged_, *config_, set_));
  const OCIO::ConstConfigRcPtr config = written();
  const char* working = config_->working_space().c_str();
  EXPECT_NE(config->getLook(street), nullptr);
  EXPECT_NO_THROW((void)config->getProcessor(working, street)->getDefaultCPUProcessor());
  std::vector<std::string> got;
  for (int d = 0; d < config->getNumDisplaysAll(); ++d) {
    const char* display = config->getDisplayAll(d);
    for (int v = 0; v < config->getNumViews(display); ++v)
      if (std::string(config->getView(display, v)) == street) got.emplace_back(display);
  }
  EXPECT_EQ(got, GetParam().displays);
  for (const std::string& display : got) {
    if (display == "Broken") continue;
    const auto seen = config->getProcessor(working, display.c_str(), street, OCIO::TRANSFORM_DIR_FORWARD)
                          ->getDefaultCPUProcessor();
    float blue[3] = {0.002f, 0.005f, 0.02f};
    seen->applyRGB(blue);
    EXPECT_GT(blue[2], 0) << display;
  }
}

TEST_P(EveryKind, a_view_is_the_look_before_the_display_s_first_picture) {
  const OCIO::ConstConfigRcPtr config = written();
  const std::string working = config_->working_space();
  for (const std::string& display : GetParam().displays) {
    if (display == "Broken") continue;
    std::string first;
    for (const auto kind : {OCIO::VIEW_DISPLAY_DEFINED, OCIO::VIEW_SHARED})
      for (int v = 0; first.empty() && v < config_->ocio()->getNumViews(kind, display.c_str()); ++v) {
        const std::string view = config_->ocio()->getView(kind, display.c_str(), v);
        if (view != "Raw") first = view;
      }
    const auto apply = [&](const OCIO::ConstProcessorRcPtr& processor, std::array<float, 3>& rgb) {
      processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS)->applyRGB(rgb.data());
    };
    std::array<float, 3> seen = {0.02f, 0.05f, 0.2f}, expected = seen;
    apply(config->getProcessor(working.c_str(), display.c_str(), street, OCIO::TRANSFORM_DIR_FORWARD), seen);
    // The view's own looks come first; a contrast on linear light, in the one config that has one.
    const OCIO::LookTransformRcPtr look = OCIO::LookTransform::Create();
    look->setSrc(working.c_str());
    look->setDst(working.c_str());
    look->setLooks(config->getDisplayViewLooks(display.c_str(), street));
    apply(config->getProcessor(look), expected);
    const OCIO::DisplayViewTransformRcPtr plain = OCIO::DisplayViewTransform::Create();
    plain->setSrc(working.c_str());
    plain->setDisplay(display.c_str());
    plain->setView(first.c_str());
    plain->setLooksBypass(true);
    apply(config->getProcessor(plain), expected);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 2e-6f) << display;
  }
}

TEST_P(EveryKind, luts_go_beside_the_config_where_it_searches) {
  EXPECT_EQ(merged_.lut_folder, folder_.path(GetParam().lut_folder));
  EXPECT_STREQ(written()->getSearchPath(), GetParam().search_path);
}

TEST_P(EveryKind, the_same_names_are_refused_a_second_time) {
  (void)written();
  try {
    (void)merge_looks(ColourConfig::from_file(file_, {}, GetParam().working), set_.entries);
    FAIL() << "accepted a second time";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::config);
    EXPECT_NE(std::string(e.what()).find(street), std::string::npos);
  }
}

TEST_P(EveryKind, a_look_of_a_second_merge_is_not_put_behind_that_of_the_first) {
  std::vector<LookEntry> second(1);
  second[0].name = "Second";
  second[0].file = "second.clf";
  const auto views_of_second = [&](const ColourConfig& config) {
    const auto text = merge_looks(config, second).text;
    const auto merged = OCIO::Config::CreateFromFile(folder_.write("twice.ocio", text).c_str());
    std::map<std::string, std::array<std::string, 3>> out;
    for (const std::string& display : GetParam().displays)
      out[display] = {merged->getDisplayViewLooks(display.c_str(), "Second"),
                      merged->getDisplayViewTransformName(display.c_str(), "Second"),
                      merged->getDisplayViewColorSpaceName(display.c_str(), "Second")};
    return out;
  };
  const auto alone = views_of_second(*config_);
  (void)written();
  EXPECT_EQ(views_of_second(ColourConfig::from_file(file_, {}, GetParam().working)), alone);
}

TEST_P(EveryKind, line_ends_of_windows_stay) {
  std::string text;
  for (const char c : std::string(GetParam().text)) text += (c == '\n' ? "\r" : "") + std::string(1, c);
  const ColourConfig config =
      ColourConfig::from_file(folder_.write("windows.ocio", text), {}, GetParam().working);
  const MergedConfig merged = merge_looks(config, set_.entries);
  EXPECT_FALSE(merged.rewritten);
  EXPECT_EQ(std::count(merged.text.begin(), merged.text.end(), '\n'),
            std::count(merged.text.begin(), merged.text.end(), '\r'));
}

INSTANTIATE_TEST_SUITE_P(Configs, EveryKind, testing::ValuesIn(kinds()),
                         [](const auto& kind) { return std::string(kind.param.name); });

class Merge : public testing::Test {
 protected:
  MergedConfig merged(const std::string& text) {
    return merge_looks(ColourConfig::from_file(folder_.write("config.ocio", text)), entries());
  }
  std::vector<LookEntry> entries() const {
    std::vector<LookEntry> out(1);
    out[0].name = street;
    out[0].file = "a.clf";
    return out;
  }
  OCIO::ConstConfigRcPtr read(const MergedConfig& merged) const {
    return OCIO::Config::CreateFromFile(folder_.write("config.ocio", merged.text).c_str());
  }
  static std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  }

  test::Folder folder_;
};

TEST_F(Merge, displays_that_begin_with_the_same_shared_view_share_the_new_one) {
  const OCIO::ConstConfigRcPtr config = read(merged(test::aces));
  ASSERT_EQ(config->getNumViews(OCIO::VIEW_SHARED, ""), 4);
  EXPECT_STREQ(config->getView(OCIO::VIEW_SHARED, "", 3), street);
  EXPECT_STREQ(config->getDisplayViewColorSpaceName("", street), "<USE_DISPLAY_NAME>");
  EXPECT_EQ(config->getNumViews(OCIO::VIEW_SHARED, "sRGB - Display"), 3);
  EXPECT_EQ(config->getNumViews(OCIO::VIEW_SHARED, "PQ - Display"), 2);
  EXPECT_STREQ(config->getDisplayViewTransformName("P3-D65 - Display", street), "SDR");
  EXPECT_STREQ(config->getDisplayViewTransformName("PQ - Display", street), "HDR");
  EXPECT_STREQ(config->getDisplayViewColorSpaceName("PQ - Display", street), "PQ - Display");
}

TEST_F(Merge, a_space_has_what_its_neighbours_have) {
  const OCIO::ConstColorSpaceRcPtr aces = read(merged(test::aces))->getColorSpace(street);
  ASSERT_EQ(aces->getNumCategories(), 1);
  EXPECT_STREQ(aces->getCategory(0), "file-io");
  EXPECT_STREQ(aces->getEncoding(), "scene-linear");
  EXPECT_STREQ(aces->getEqualityGroup(), "");
  // An equality group that is shared would make the look no conversion at all.
  const std::string file = folder_.write("config.ocio", test::no_interchange);
  const MergedConfig grouped = merge_looks(ColourConfig::from_file(file, {}, rec709), entries());
  EXPECT_STREQ(read(grouped)->getColorSpace(street)->getEqualityGroup(), street);
}

TEST_F(Merge, a_display_whose_views_do_not_load_gets_one_like_them_and_is_named) {
  const std::string file = folder_.write("config.ocio", test::no_interchange);
  const MergedConfig result = merge_looks(ColourConfig::from_file(file, {}, rec709), entries());
  EXPECT_EQ(result.unproven_displays, std::vector<std::string>{"Broken"});
  EXPECT_STREQ(read(result)->getDisplayViewColorSpaceName("Broken", street), "lost");
  ASSERT_EQ(result.views.size(), 1u);
  EXPECT_EQ(result.views[0].display, "sRGB");
}

TEST_F(Merge, a_view_that_does_not_load_is_passed_over_for_one_that_does) {
  const std::string text =
      replaced(test::no_interchange, "  - !<View> {name: Lost, colorspace: lost}",
               "  - !<View> {name: Lost, colorspace: lost}\n  - !<View> {name: Found, colorspace: sRGB}");
  const MergedConfig result =
      merge_looks(ColourConfig::from_file(folder_.write("config.ocio", text), {}, rec709), entries());
  EXPECT_TRUE(result.unproven_displays.empty());
  EXPECT_STREQ(read(result)->getDisplayViewColorSpaceName("Broken", street), "sRGB");
}

TEST_F(Merge, a_list_of_active_views_may_be_of_any_layout) {
  for (const char* layout : {"active_views:\n  [Graded,\n  Raw]", "active_views:\n  - Graded\n  - Raw",
                             "active_views:\n- Graded", "active_views: [Graded]  # [one]"}) {
    const MergedConfig result = merged(replaced(test::studio, "active_views: [Graded, Raw]", layout));
    EXPECT_FALSE(result.rewritten) << layout;
    EXPECT_EQ(read(result)->getNumViews("wall 2"), 2) << layout;
  }
}

TEST_F(Merge, a_layout_that_lines_cannot_be_put_into_is_written_anew) {
  const MergedConfig result = merged(
      replaced(test::studio,
               "displays:\n  monitor:\n    - !<View> {name: Raw, colorspace: raw}   # first, on purpose\n"
               "    - !<View> {name: Graded, colorspace: out}\n\n  \"wall 2\":\n    - !<View> {name: Graded, "
               "colorspace: out}\n",
               "displays: {monitor: [!<View> {name: Graded, colorspace: out}]}\n"));
  EXPECT_TRUE(result.rewritten);
  const OCIO::ConstConfigRcPtr config = read(result);
  EXPECT_EQ(config->getNumLooks(), 2);
  EXPECT_STREQ(config->getDisplayViewLooks("monitor", street), street);
}

TEST_F(Merge, the_first_look_of_a_config_changes_nothing) {
  EXPECT_STREQ(read(merged(test::studio))->getLookNameByIndex(0), "Photopic");
  EXPECT_STREQ(read(merged(test::aces))->getLookNameByIndex(0), "Gamut compression");
}

TEST_F(Merge, names_of_shared_views_and_named_transforms_clash_too) {
  const std::string named =
      replaced(test::aces, "colorspaces:\n  - !<ColorSpace>\n    name: ACES2065-1",
               "named_transforms:\n  - !<NamedTransform>\n    name: " + std::string(street) +
                   "\n    transform: !<RangeTransform> {min_in_value: 0, min_out_value: 0}\n\n"
                   "colorspaces:\n  - !<ColorSpace>\n    name: ACES2065-1");
  const std::string shared =
      replaced(test::aces, "shared_views:\n",
               "shared_views:\n  - !<View> {name: " + std::string(street) + ", colorspace: ACEScg}\n");
  for (const std::string& text : {named, shared}) {
    try {
      (void)merged(text);
      ADD_FAILURE() << "accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::config);
      EXPECT_NE(std::string(e.what()).find(street), std::string::npos) << e.what();
    }
  }
}

TEST_F(Merge, what_does_not_load_is_an_error_that_names_it) {
  const ColourConfig config = ColourConfig::from_file(folder_.write("config.ocio", test::studio));
  const LookSet set = looks_for(config);
  MergedConfig result = merge_looks(config, set.entries);
  EXPECT_NO_THROW(require_all_load(result, config, set));
  const struct {
    std::string what, by, named;
  } rows[] = {
      {"looks: " + std::string(street) + "}", "looks: \"\"}", "view"},
      {", " + std::string(street) + "]", "]", "view"},
      {"to_scene_reference: !<ColorSpaceTransform> {src: lin, dst: lin}",
       "to_scene_reference: !<FileTransform> {src: none.clf}", "colour space"},
      {"\n    transform: !<MatrixTransform> {", "\n    transform: !<FileTransform> {src: none.clf, ", "look"},
      {"process_space: lin", "process_space: none", "whole of"}};
  for (const auto& row : rows) {
    MergedConfig worse = result;
    worse.text = replaced(worse.text, row.what, row.by);
    try {
      require_all_load(worse, config, set);
      ADD_FAILURE() << "accepted " << row.by;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::config);
      EXPECT_NE(std::string(e.what()).find(row.named + " '"), std::string::npos) << e.what();
    }
  }
}

// Debian's blender-data has it; it says nothing of looks where that is not installed.
TEST(BlenderConfig, gets_looks_without_losing_a_line) {
  const std::string original = "/usr/share/blender/datafiles/colormanagement/config.ocio";
  if (!std::filesystem::exists(original)) GTEST_SKIP() << "blender-data is not installed";
  std::vector<LookEntry> entries(1);
  entries[0].name = street;
  entries[0].file = "a.clf";
  const MergedConfig merged = merge_looks(ColourConfig::from_file(original), entries);
  EXPECT_FALSE(merged.rewritten);
  std::istringstream diff(line_diff(test::read_text(original), merged.text));
  int removed = 0;
  for (std::string line; std::getline(diff, line);) removed += line[0] == '-' ? 1 : 0;
  EXPECT_EQ(removed, 1) << "only active_views may change";
}

}  // namespace
}  // namespace scotopic

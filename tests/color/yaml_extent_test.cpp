// What a YAML text stands for, aliases written out, before a parser sees it.
#include "color/config/yaml_extent.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "color/colour_config.h"
#include "color/config/config_glance.h"

namespace scotopic {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

/// Lists of ten aliases of the list before: 10^levels.
std::string bomb(int levels, const std::string& before, const std::string& after) {
  std::string text = before + "&n0 [x]" + after;
  for (int i = 1; i <= levels; ++i) {
    const std::string alias = "*n" + std::to_string(i - 1);
    text += before + "&n" + std::to_string(i) + " [" + repeated(alias + ",", 9) + alias + "]" + after;
  }
  return text;
}

TEST(YamlExtent, a_text_without_aliases_is_as_long_as_it_is) {
  for (const std::string text :
       {"", "a", "a: b\n", "# *a &b\n", "a: '*b'\nb: \"&a *a\"\n", "a: 5 * b & c\n", "\n\n  \n"}) {
    EXPECT_EQ(yaml_extent(text).size, static_cast<std::int64_t>(text.size())) << text;
    EXPECT_FALSE(yaml_extent(text).endless);
  }
}

TEST(YamlExtent, an_alias_counts_as_what_it_stands_for) {
  const struct {
    std::string text;
    std::int64_t more;  // than its own characters
  } rows[] = {
      // In flow style a node ends at its comma or bracket, in block style where indentation does.
      {"[&a xx, *a, *a]", 2 * 6},
      {"{k: &a {x: [1, 2]}, l: *a}", 18},
      {"k: &a xx\nl: *a\nm: *a\n", 2 * 6},
      {"k: &a\n  x: 1\n  y: 2\nl: *a\n", 17},
      {"k: &a\n- x\n- y\nl: *a\n", 11},
      {"- &a\n  x: 1\n- *a\n- *a\n", 2 * 10},
      {"- - &a x\n  - *a\n", 9},
      {"- k: &a x\n  l: 1\n- *a\n", 7},
      {"&a k: 1\nl: *a\n", 5},
      {"&a\nk: 1\nl: *b\n", 0},
      // A node that holds aliases is as large as they make it.
      {"a: &a xxxx\nb: &b [*a, *a]\nc: *b\n", 2 * 8 + (12 + 2 * 8)},
      // The last of a name counts.
      {"[&a x, &a yyyy, *a]", 7},
      // No aliases: text.
      {"a: &a xx\nb: |\n  *a\n  *a\nc: *a\n", 6},
      {"a: &a xx\nb: >-\n  *a\n\n  *a\nc: *a\n", 6},
      {"a: &a xx\nb: it's\n  *a 'x\nc: *a\n", 6},
      {"a: &a xx\nb: \"\\\" *a\n *a\"\nc: '*a''*a'\n", 0},
      {"a: &a xx\nb: x *a  # *a\n", 0},
      {"a: &a xx\nb: !<!tag> *a\n", 6},
      {"[&a x, don't, *a]", 5},
      {"[x\n 'y, &a z, *a]", 5},
  };
  for (const auto& row : rows) {
    // Where a node ends in block style, its line's end belongs to it.
    const std::int64_t more = yaml_extent(row.text).size - static_cast<std::int64_t>(row.text.size());
    EXPECT_GE(more, row.more - 3) << row.text;
    EXPECT_LE(more, row.more + 3) << row.text;
  }
}

TEST(YamlExtent, aliases_of_aliases_multiply_in_any_style) {
  for (const std::string& text :
       {bomb(9, "- ", "\n"), "[" + bomb(9, "", ",\n") + "]", bomb(9, "k: ", "\n"),
        bomb(9, "- - k: !<T> ", "\n"), "x: don't\n" + bomb(9, "k: ", "\n"),
        "x: |\n 'text\n" + bomb(9, "k: ", "\n"), "x:\n  plain\n  'more\n" + bomb(9, "k: ", "\n"),
        "--- # 'x\n" + bomb(9, "k: ", "\n"), "%YAML 1.2\n---\n" + bomb(9, "k: ", "\n"),
        "\"k\": {'a': \"'\"}\n" + bomb(9, "\"k\": ", "\r\n")}) {
    EXPECT_GT(yaml_extent(text).size, 1'000'000'000) << text.substr(0, 60);
    EXPECT_LT(yaml_extent(text).size, 200'000'000'000) << text.substr(0, 60);
  }
  EXPECT_EQ(yaml_extent(bomb(100, "- ", "\n")).size, std::int64_t{1} << 60);
}

TEST(YamlExtent, an_alias_within_what_it_names_never_ends) {
  for (const char* text : {"&a [*a]", "k: &a\n  - x: *a\n", "k: &a {b: [1, *a]}\n", "- &a\n  - *a\n",
                           "k: &a x\nl: &a\n  m: *a\n"})
    EXPECT_TRUE(yaml_extent(text).endless) << text;
  for (const char* text :
       {"[&a 1, *a]", "k: &a 1\nl: *a\n", "- &a 1\n- *a\n", "k: &a\n  x: 1\nl: *a\n", "k: &a\n- 1\nl: *a\n"})
    EXPECT_FALSE(yaml_extent(text).endless) << text;
}

TEST(YamlExtent, depth_is_seen_in_any_style_and_through_aliases) {
  std::string block, chain = "- &n0 [x]\n";
  for (int i = 0; i < 150; ++i) block += std::string(static_cast<std::size_t>(i), ' ') + "k:\n";
  for (int i = 1; i <= 150; ++i) chain += "- &n" + std::to_string(i) + " [*n" + std::to_string(i - 1) + "]\n";
  for (const std::string& text : {repeated("[", 150) + repeated("]", 150), repeated("{a: ", 150),
                                  repeated("- ", 150) + "x\n", block, chain})
    EXPECT_GE(yaml_extent(text).depth, 148) << text.substr(0, 40);
  EXPECT_LE(yaml_extent(repeated("- [a, {b: c}]\nk:\n  l: m\n", 1000)).depth, 6);
}

TEST(YamlExtent, hostile_sizes_take_no_time) {
  for (const std::string& text :
       {repeated("[", 3'000'000), repeated("&a ", 1'000'000), repeated("&a [*a],", 300'000),
        repeated("- ", 1'000'000), repeated("'", 3'000'001), repeated("*a ", 1'000'000),
        repeated("k: |\n", 600'000), repeated("!<", 1'000'000)})
    (void)yaml_extent(text);
  SUCCEED();
}

class Config : public testing::Test {
 protected:
  std::string written(const std::string& text) const {
    const std::string file = testing::TempDir() + "/scotopic_glance_" + std::to_string(getpid()) + ".ocio";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  ExitCode code(const std::string& text, const Limits& limits = {}) const {
    try {
      require_modest_config(written(text), limits);
      return ExitCode::done;
    } catch (const Error& e) {
      message_ = e.what();
      return e.code();
    }
  }
  mutable std::string message_;
};

// The attack as published: transforms of transforms of transforms.
TEST_F(Config, that_would_take_all_memory_is_refused_at_once_by_the_limit) {
  std::string text =
      "ocio_profile_version: 2\nroles: {default: raw}\ncolorspaces:\n  - !<ColorSpace> {name: t, "
      "to_scene_reference: &b0 "
      "!<GroupTransform> {children: [!<CDLTransform> {slope: [1,1,1]}]}}\n";
  for (int i = 1; i <= 10; ++i) {
    const std::string before = "*b" + std::to_string(i - 1);
    text += "  - !<ColorSpace> {name: t" + std::to_string(i) + ", to_scene_reference: &b" +
            std::to_string(i) + " !<GroupTransform> {children: [" + repeated(before + ",", 7) + before +
            "]}}\n";
  }
  EXPECT_EQ(code(text), ExitCode::limit);
  EXPECT_NE(message_.find("aliases"), std::string::npos) << message_;
  EXPECT_NE(message_.find("--max-config-size"), std::string::npos) << message_;
  EXPECT_THROW((void)ColourConfig::from_file(written(text)), Error);
}

TEST_F(Config, with_a_few_aliases_or_as_people_have_it_passes) {
  EXPECT_EQ(code("a: &lin {b: [1, 2, 3]}\n" + repeated("c: *lin\n", 1000)), ExitCode::done);
  for (const char* file : {SCOTOPIC_SOURCE_DIR "/ocio_config/config.ocio",
                           "/usr/share/blender/datafiles/colormanagement/config.ocio"}) {
    if (!std::filesystem::exists(file)) continue;
    EXPECT_NO_THROW(require_modest_config(file, {}));
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(yaml_extent(text).size, static_cast<std::int64_t>(text.size()));
    EXPECT_LE(yaml_extent(text).depth, 12);
  }
}

TEST_F(Config, that_is_no_text_or_nests_without_end_is_refused) {
  EXPECT_EQ(code(std::string("\xff\xfe"
                             "a\0:\0",
                             6)),
            ExitCode::config);
  EXPECT_EQ(code("a: &a [*a]\n"), ExitCode::config);
  EXPECT_EQ(code(repeated("[", 129)), ExitCode::config);
  EXPECT_EQ(code(repeated("[", 100) + repeated("]", 100)), ExitCode::done);
  EXPECT_EQ(code("PK\3\4\0\0 an archive is OpenColorIO's to read"), ExitCode::done);
  Limits small;
  small.config = 20;
  EXPECT_EQ(code("[&a xxxxxxxxx, *a]", small), ExitCode::limit);
}

TEST_F(Config, of_a_younger_profile_names_the_release_it_needs) {
  EXPECT_EQ(too_new(written("# x\nocio_profile_version: 2\n")), "");
  EXPECT_EQ(too_new(written("ocio_profile_version: 1\n")), "");
  EXPECT_EQ(too_new(written("roles: {}\n")), "");
  EXPECT_EQ(too_new(written("# x\nocio_profile_version: 2.99\n")).substr(0, 34),
            "needs OpenColorIO 2.99; this is 2.");
  EXPECT_EQ(too_new(written("ocio_profile_version: 3\n")).substr(0, 33), "needs OpenColorIO 3.0; this is 2.");
}

}  // namespace
}  // namespace scotopic

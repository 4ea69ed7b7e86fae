// Lines of YAML found and added to.
#include "looks/merge/yaml_block.h"

#include <gtest/gtest.h>

#include "looks/merge/config_lines.h"
#include "looks/merge/line_diff.h"

namespace scotopic {
namespace {

TEST(YamlBlock, names_come_to_the_end_of_a_list_in_flow_style) {
  const struct {
    const char *before, *after;  // nullptr: there is no such list
  } rows[] = {{"v: [a, b]", "v: [a, b, N 1 (x)]"},
              {"v: [a, b ]  # of [two]", "v: [a, b, N 1 (x) ]  # of [two]"},
              {"v: []", "v: [N 1 (x)]"},
              {"v: [\"a]\", 'b]', it's]", "v: [\"a]\", 'b]', it's, N 1 (x)]"},
              {"v: [a,  # [one\n    b]", "v: [a,  # [one\n    b, N 1 (x)]"},
              {"v:\n  - a", nullptr},
              {"v: [a, b", nullptr}};
  for (const auto& row : rows) {
    Lines lines = lines_of(row.before);
    ASSERT_EQ(append_to_flow(lines, 0, lines.size(), {"N 1 (x)"}), row.after != nullptr) << row.before;
    EXPECT_EQ(text_of_lines(lines), std::string(row.after ? row.after : row.before) + "\n");
  }
}

TEST(YamlBlock, a_scalar_is_quoted_where_it_would_be_read_as_something_else) {
  for (const char* plain : {"Mesopic 0.1 nit (street lighting)", "a-b", "x"})
    EXPECT_EQ(yaml_scalar(plain), plain);
  for (const char* other : {"a, b", "[a", "a: b", "0.1", "", " a", "a ", "#a", "*a", "a/b"})
    EXPECT_EQ(yaml_scalar(other), "\"" + std::string(other) + "\"");
  EXPECT_EQ(yaml_scalar("a\"\\"), "\"a\\\"\\\\\"");
}

TEST(YamlBlock, a_key_takes_items_where_it_has_no_value) {
  const struct {
    const char* before;
    bool open;
    const char* after;
  } rows[] = {{"looks:", true, "looks:"},
              {"looks: ", true, "looks: "},
              {"looks: # none", true, "looks: # none"},
              {"looks: []", true, "looks: "},
              {"looks: [] # none", true, "looks:  # none"},
              {"looks: [a]", false, "looks: [a]"}};
  for (const auto& row : rows) {
    std::string line = row.before;
    EXPECT_EQ(open_for_items(line), row.open) << row.before;
    EXPECT_EQ(line, row.after);
  }
}

TEST(YamlBlock, blocks_end_where_the_next_key_begins_and_keys_may_be_quoted) {
  const Lines lines = lines_of(
      "a:\r\n  \"x: y\":\r\n    - 1\r\n\r\n    - 2\r\n      more\r\n  z: 1\r\n\r\n# said\r\nb:\r\n- 3\r\n");
  EXPECT_EQ(lines.front(), "a:");
  const Block a = find_block(lines, "a"), b = find_block(lines, "b"), x = child_block(lines, a, "x: y");
  EXPECT_EQ(a.end, 7u);
  EXPECT_EQ(b.key, 9u);
  ASSERT_TRUE(x.found);
  const std::vector<Lines> items = items_of(lines, x);
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0], Lines{"    - 1"});
  EXPECT_EQ(items[1], (Lines{"    - 2", "      more"}));
  EXPECT_EQ(items_of(lines, b), std::vector<Lines>{{"- 3"}});
  EXPECT_FALSE(child_block(lines, a, "y").found);
  EXPECT_EQ(line_end_of("a\r\nb\n"), "\r\n");
}

TEST(ConfigLines, texts_may_differ_by_the_rounding_of_their_numbers_alone) {
  const struct {
    const char *a, *b;
    bool same;
  } rows[] = {{"x: 0.1\n", "x: 0.10000000000000001\n", true},
              {"x: 1e-05,\n", "x: 1.0000000000000001e-05,\n", true},
              {"x: [2.52168618674388, 1]\n", "x: [2.5216861867438799, 1]\n", true},
              {"x: 0.1\n", "x: 0.1000001\n", false},
              {"x: 0.1\n", "x: 0.1\ny: 1\n", false},
              {"x: 1\n", "x: -1\n", false},
              {"ACES 1.0\n", "ACES 1.1\n", false},
              {"abc\n", "abd\n", false},
              {"a 5\n", "a\n", false}};
  for (const auto& row : rows) EXPECT_EQ(same_but_for_rounding(row.a, row.b), row.same) << row.a << row.b;
}

TEST(LineDiff, shows_what_changed_and_nothing_else) {
  EXPECT_EQ(line_diff("a\nb\nc\n", "a\nb\nc\n"), "");
  EXPECT_EQ(line_diff("a\nb\nc\n", "a\nb\nx\ny\nc\n"), "@@ -3 +3 @@\n+x\n+y\n");
  EXPECT_EQ(line_diff("a\nb\nc\n", "a\nB\nc\n"), "@@ -2 +2 @@\n-b\n+B\n");
  EXPECT_EQ(line_diff("a\n", "a\nb\n"), "@@ -2 +2 @@\n+b\n");
}

}  // namespace
}  // namespace scotopic

// Lines of YAML in block style as people and OpenColorIO write configs: keys, what is under them, items of
// lists.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scotopic {

using Lines = std::vector<std::string>;

/// Without their ends, which may be those of Windows.
Lines lines_of(const std::string& text);
/// What lines of `text` end with: "\n", or "\r\n" where the first one does.
std::string line_end_of(const std::string& text);
/// Each line with that end.
std::string text_of_lines(const Lines& lines, const std::string& line_end = "\n");

/// Count of spaces before the first other character.
std::size_t indent_of(const std::string& line);

/// A key's line and the lines under it, [key, end), without what trails blank.
struct Block {
  std::size_t key = 0, end = 0;
  bool found = false;
};

/// Of a top-level key.
Block find_block(const Lines& lines, const std::string& key);
/// Of a key one level under `parent`, as it is or quoted.
Block child_block(const Lines& lines, const Block& parent, const std::string& key);

/// List items ("- ...") of a block, each with its lines.
std::vector<Lines> items_of(const Lines& lines, const Block& block);
/// Where their dashes stand; `usual` where there are none.
std::size_t item_indent(const Lines& lines, const Block& block, std::size_t usual);

/// Whether items can follow a key's line: it has no value. An empty list, "[]", is taken away.
bool open_for_items(std::string& key_line);

/// Before these lines.
void insert(Lines& lines, std::size_t at, const Lines& more);

/// Names at the end of the first list in flow style, "[a, b]", of lines [first, last); false where there is
/// none.
bool append_to_flow(Lines& lines, std::size_t first, std::size_t last, const std::vector<std::string>& names);

/// Plain, or in double quotes where YAML, also within [], would take it for something else.
std::string yaml_scalar(const std::string& text);

}  // namespace scotopic

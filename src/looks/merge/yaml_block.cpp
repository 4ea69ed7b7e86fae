#include "looks/merge/yaml_block.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>

namespace scotopic {
namespace {

bool blank_or_comment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string::npos || line[first] == '#';
}

/// The block of `key` at this indent within [first, last).
Block find_block(const Lines& lines, const std::string& key, std::size_t indent, std::size_t first,
                 std::size_t last) {
  Block block;
  for (std::size_t i = first; i < last; ++i) {
    const std::string& line = lines[i];
    if (blank_or_comment(line)) continue;
    if (!block.found) {
      if (indent_of(line) != indent || line.compare(indent, key.size() + 1, key + ":") != 0) continue;
      block = {i, i + 1, true};
    } else {
      // List items may stand at their key's own indent.
      if (indent_of(line) < indent || (indent_of(line) == indent && line[indent] != '-')) break;
      block.end = i + 1;
    }
  }
  return block;
}

/// The first line under a block's key that says something; block.end where there is none.
std::size_t first_line(const Lines& lines, const Block& block) {
  std::size_t i = std::min(block.key + 1, block.end);
  while (i < block.end && blank_or_comment(lines[i])) ++i;
  return i;
}

struct TextPlace {
  std::size_t line = 0, column = 0;
};

/// Past a quoted scalar's end in its line.
std::size_t after_quoted(const std::string& line, std::size_t at) {
  const char quote = line[at];
  for (++at; at < line.size() && line[at] != quote; ++at)
    if (quote == '"' && line[at] == '\\') ++at;
  return at;
}

/// The bracket that closes the first one that is opened.
std::optional<TextPlace> closing_bracket(const Lines& lines, std::size_t first, std::size_t last) {
  int depth = 0;
  for (std::size_t l = first; l < last; ++l)
    for (std::size_t c = 0; c < lines[l].size(); ++c) {
      const char at = lines[l][c], before = c == 0 ? ' ' : lines[l][c - 1];
      if (at == '#' && before == ' ') break;
      if ((at == '"' || at == '\'') && (before == ' ' || before == '[' || before == ','))
        c = after_quoted(lines[l], c);
      if (at == '[') ++depth;
      if (at == ']' && --depth == 0) return TextPlace{l, c};
    }
  return std::nullopt;
}

}  // namespace

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

std::string line_end_of(const std::string& text) {
  const std::size_t end = text.find('\n');
  return end != std::string::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

std::string text_of_lines(const Lines& lines, const std::string& line_end) {
  std::string text;
  for (const std::string& line : lines) text += line + line_end;
  return text;
}

std::size_t indent_of(const std::string& line) { return std::min(line.find_first_not_of(' '), line.size()); }

Block find_block(const Lines& lines, const std::string& key) {
  return find_block(lines, key, 0, 0, lines.size());
}

Block child_block(const Lines& lines, const Block& parent, const std::string& key) {
  if (!parent.found) return {};
  const std::size_t first = first_line(lines, parent);
  const std::size_t indent = first < parent.end ? indent_of(lines[first]) : 2;
  for (const std::string& written : {key, "\"" + key + "\"", "'" + key + "'"}) {
    const Block block = find_block(lines, written, indent, parent.key + 1, parent.end);
    if (block.found) return block;
  }
  return {};
}

std::vector<Lines> items_of(const Lines& lines, const Block& block) {
  std::vector<Lines> items;
  if (!block.found) return items;
  const std::size_t indent = item_indent(lines, block, 0);
  for (std::size_t i = block.key + 1; i < block.end; ++i) {
    const std::size_t at = indent_of(lines[i]);
    if (at == indent && at < lines[i].size() && lines[i][at] == '-') items.emplace_back();
    if (!items.empty()) items.back().push_back(lines[i]);
  }
  for (Lines& item : items)
    while (!item.empty() && blank_or_comment(item.back())) item.pop_back();
  return items;
}

std::size_t item_indent(const Lines& lines, const Block& block, std::size_t usual) {
  const std::size_t first = first_line(lines, block);
  return first < block.end ? indent_of(lines[first]) : usual;
}

bool open_for_items(std::string& key_line) {
  const std::size_t colon = key_line.find(": ");
  std::string rest = colon == std::string::npos ? "" : key_line.substr(colon + 2);
  rest = rest.substr(0, rest.rfind('#', 0) == 0 ? 0 : rest.find(" #"));
  while (!rest.empty() && rest.back() == ' ') rest.pop_back();
  if (rest == "[]") key_line.replace(key_line.find("[]", colon), 2, "");
  return rest.empty() || rest == "[]";
}

void insert(Lines& lines, std::size_t at, const Lines& more) {
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
}

bool append_to_flow(Lines& lines, std::size_t first, std::size_t last,
                    const std::vector<std::string>& names) {
  const std::optional<TextPlace> end = closing_bracket(lines, first, last);
  if (!end) return false;
  std::string& line = lines[end->line];
  std::size_t at = end->column;
  while (at > 0 && line[at - 1] == ' ') --at;
  const bool empty = at > 0 && line[at - 1] == '[';
  std::string more;
  for (const std::string& name : names) more += (more.empty() && empty ? "" : ", ") + yaml_scalar(name);
  line.insert(at, more);
  return true;
}

std::string yaml_scalar(const std::string& text) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c == ' ' || c == '.' || c == '(' || c == ')' || c == '-';
  };
  const bool starts =
      !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) && text.back() != ' ';
  if (starts && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string out = "\"";
  for (const char c : text) out += (c == '"' || c == '\\' ? std::string("\\") : std::string()) + c;
  return out + "\"";
}

}  // namespace scotopic

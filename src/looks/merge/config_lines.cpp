#include "looks/merge/config_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "looks/merge/yaml_block.h"

namespace scotopic {
namespace {

/// The block of a top-level key, or of a display within displays.
Block block_at(const Lines& lines, const std::string& key, const std::string& display) {
  return display.empty() ? find_block(lines, key) : child_block(lines, find_block(lines, key), display);
}

/// The items of a block that `before` has not, in the order of `after`; the list of shared views is not one
/// of them.
std::vector<Lines> new_items(const Lines& before, const Lines& after, const std::string& key,
                             const std::string& display = "") {
  const std::vector<Lines> old_items = items_of(before, block_at(before, key, display));
  std::vector<Lines> out;
  for (const Lines& item : items_of(after, block_at(after, key, display)))
    if (item.front().find("- !<Views>") == std::string::npos &&
        std::find(old_items.begin(), old_items.end(), item) == old_items.end())
      out.push_back(item);
  return out;
}

/// Items with their dash at `indent`; a line is left free before those of several lines.
Lines laid_out(const std::vector<Lines>& items, std::size_t indent) {
  Lines out;
  for (const Lines& item : items) {
    const std::size_t had = indent_of(item.front());
    if (item.size() > 1) out.emplace_back();
    for (const std::string& line : item)
      out.push_back(line.empty() ? line : std::string(indent, ' ') + line.substr(std::min(had, line.size())));
  }
  return out;
}

/// To the end of a top-level list, which is begun before `next` where there is none.
bool append_section(Lines& lines, const std::string& key, const std::vector<Lines>& items,
                    const std::string& next) {
  if (items.empty()) return true;
  Block block = find_block(lines, key);
  if (!block.found) {
    const Block following = find_block(lines, next);
    if (!following.found) return false;
    insert(lines, following.key, {key + ":", ""});
    block = {following.key, following.key + 1, true};
  } else if (!open_for_items(lines[block.key])) {
    return false;
  }
  insert(lines, block.end, laid_out(items, item_indent(lines, block, 2)));
  return true;
}

bool append_views(Lines& lines, const std::string& display, const std::vector<Lines>& items,
                  const std::vector<std::string>& shared) {
  const Block block = child_block(lines, find_block(lines, "displays"), display);
  if (!block.found || !open_for_items(lines[block.key])) return false;
  const auto first = lines.begin() + static_cast<std::ptrdiff_t>(block.key) + 1;
  const auto last = lines.begin() + static_cast<std::ptrdiff_t>(block.end);
  const auto list = std::find_if(
      first, last, [](const std::string& line) { return line.find("- !<Views>") == indent_of(line); });
  const auto at = static_cast<std::size_t>(list - lines.begin());
  if (!shared.empty() && (list == last || !append_to_flow(lines, at, block.end, shared))) return false;
  insert(lines, at, laid_out(items, item_indent(lines, block, indent_of(lines[block.key]) + 2)));
  return true;
}

bool lengthen_active_views(Lines& lines, const std::vector<std::string>& names) {
  const Block block = find_block(lines, "active_views");
  if (names.empty()) return true;
  if (!block.found) return false;
  if (append_to_flow(lines, block.key, block.end, names)) return true;
  if (!open_for_items(lines[block.key])) return false;
  Lines items;
  for (const std::string& name : names)
    items.push_back(std::string(item_indent(lines, block, 2), ' ') + "- " + yaml_scalar(name));
  insert(lines, block.end, items);
  return true;
}

/// search_path, where there was none or an empty one.
bool set_search_path(Lines& lines, const Lines& before, const Lines& after) {
  const Block old_path = find_block(before, "search_path"), path = find_block(after, "search_path");
  if (!path.found || (old_path.found && before[old_path.key] == after[path.key])) return true;
  const Block mine = find_block(lines, "search_path"), profile = find_block(lines, "ocio_profile_version");
  if (mine.found && mine.end != mine.key + 1) return false;
  if (mine.found)
    lines[mine.key] = after[path.key];
  else if (profile.found)
    insert(lines, profile.end, {after[path.key]});
  return mine.found || profile.found;
}

bool part_of_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e'; }

/// From there, which may be within a number, back to where that begins.
std::size_t number_start(const std::string& text, std::size_t at) {
  while (at > 0 && part_of_number(text[at - 1])) --at;
  return at;
}

}  // namespace

std::optional<std::string> with_added_lines(const std::string& user, const std::string& before,
                                            const std::string& after, const AddedViews& views) {
  Lines lines = lines_of(user);
  const Lines old_lines = lines_of(before), new_lines = lines_of(after);
  bool fits = set_search_path(lines, old_lines, new_lines);
  for (const std::string& display : views.displays) {
    const auto shared = views.shared.find(display);
    fits = fits && append_views(lines, display, new_items(old_lines, new_lines, "displays", display),
                                shared == views.shared.end() ? std::vector<std::string>{} : shared->second);
  }
  fits = fits && lengthen_active_views(lines, views.active) &&
         append_section(lines, "shared_views", new_items(old_lines, new_lines, "shared_views"), "displays") &&
         append_section(lines, "looks", new_items(old_lines, new_lines, "looks"), "colorspaces") &&
         append_section(lines, "colorspaces", new_items(old_lines, new_lines, "colorspaces"), "");
  if (!fits) return std::nullopt;
  return text_of_lines(lines, line_end_of(user));
}

bool same_but_for_rounding(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i] == b[j]) {
      ++i;
      ++j;
      continue;
    }
    i = number_start(a, i);
    j = number_start(b, j);
    char *a_end = nullptr, *b_end = nullptr;
    const double x = std::strtod(a.c_str() + i, &a_end), y = std::strtod(b.c_str() + j, &b_end);
    if (a_end == a.c_str() + i || b_end == b.c_str() + j) return false;
    if (!(std::abs(x - y) <= 1e-12 * std::max(std::abs(x), std::abs(y)))) return false;
    i = static_cast<std::size_t>(a_end - a.c_str());
    j = static_cast<std::size_t>(b_end - b.c_str());
  }
  return i == a.size() && j == b.size();
}

}  // namespace scotopic

#include "looks/config/config_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "looks/verify/inspect.h"
#include "base/error.h"

namespace OCIO = OCIO_NAMESPACE;
namespace fs = std::filesystem;

namespace scotopic {
namespace {

using Lines = std::vector<std::string>;

constexpr const char* folder_name = "scotopic";

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of_lines(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

bool blank_or_comment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

std::size_t indent_of(const std::string& line) { return std::min(line.find_first_not_of(' '), line.size()); }

/// A YAML block: its key's line and the lines under it, [first, last), without what trails blank.
struct Block {
  std::size_t key = 0, end = 0;
  bool found = false;
};

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

Block find_block(const Lines& lines, const std::string& key) {
  return find_block(lines, key, 0, 0, lines.size());
}

/// List items ("- !<Tag>") of a block, each with its lines.
std::vector<Lines> items_of(const Lines& lines, const Block& block) {
  std::vector<Lines> items;
  std::size_t indent = 0;
  for (std::size_t i = block.key + 1; i < block.end; ++i) {
    const std::size_t at = indent_of(lines[i]);
    if (items.empty()) indent = at;
    if (at == indent && at < lines[i].size() && lines[i][at] == '-') items.emplace_back();
    if (!items.empty()) items.back().push_back(lines[i]);
  }
  for (Lines& item : items)
    while (!item.empty() && blank_or_comment(item.back())) item.pop_back();
  return items;
}

/// The items at the end of a block that `before` has not.
Lines new_items(const Lines& before, const Lines& after, const std::string& key,
                const std::string& display = "") {
  const auto block = [&](const Lines& lines) {
    const Block top = find_block(lines, key);
    return display.empty() || !top.found ? top : find_block(lines, display, 2, top.key + 1, top.end);
  };
  const Block old_block = block(before), new_block = block(after);
  const std::vector<Lines> old_items = old_block.found ? items_of(before, old_block) : std::vector<Lines>{};
  Lines out;
  for (const Lines& item : items_of(after, new_block)) {
    if (std::find(old_items.begin(), old_items.end(), item) != old_items.end()) continue;
    if (display.empty()) out.push_back("");
    out.insert(out.end(), item.begin(), item.end());
  }
  return out;
}

void insert(Lines& lines, std::size_t at, const Lines& more) {
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), more.begin(), more.end());
}

/// Display names stand in YAML as they are, or quoted.
Block display_block(const Lines& lines, const std::string& display) {
  const Block displays = find_block(lines, "displays");
  if (!displays.found) return {};
  std::size_t first = displays.key + 1;
  while (first < displays.end && blank_or_comment(lines[first])) ++first;
  const std::size_t indent = first < displays.end ? indent_of(lines[first]) : 2;
  for (const std::string& key : {display, "\"" + display + "\"", "'" + display + "'"}) {
    const Block block = find_block(lines, key, indent, displays.key + 1, displays.end);
    if (block.found) return block;
  }
  return {};
}

/// The new lines of OCIO's own text put into the user's; an empty result where the layout is not understood.
std::string inserted(const std::string& user, const std::string& before, const std::string& after,
                     const OCIO::Config& config) {
  Lines lines = lines_of(user);
  const Lines old_lines = lines_of(before), new_lines = lines_of(after);
  const Block spaces = find_block(lines, "colorspaces");
  if (!spaces.found || lines[spaces.key].find('[') != std::string::npos) return "";
  insert(lines, spaces.end, new_items(old_lines, new_lines, "colorspaces"));
  const Block looks = find_block(lines, "looks");
  const Lines look_items = new_items(old_lines, new_lines, "looks");
  if (looks.found) {
    if (lines[looks.key].find('[') != std::string::npos) return "";
    insert(lines, looks.end, look_items);
  } else {
    insert(lines, spaces.key, {"looks:"});
    insert(lines, spaces.key + 1, look_items);
    insert(lines, spaces.key + 1 + look_items.size(), {""});
  }
  for (int d = 0; d < config.getNumDisplaysAll(); ++d) {
    const std::string display = config.getDisplayAll(d);
    const Block block = display_block(lines, display);
    if (!block.found) return "";
    insert(lines, block.end, new_items(old_lines, new_lines, "displays", display));
  }
  const Block active = find_block(lines, "active_views"), new_active = find_block(new_lines, "active_views");
  if (active.found && new_active.found) {
    if (active.end != active.key + 1) return "";
    lines[active.key] = new_lines[new_active.key];
  }
  return text_of_lines(lines);
}

std::string serialised(const OCIO::Config& config) {
  std::ostringstream text;
  config.serialize(text);
  return text.str();
}

void refuse_clashes(const OCIO::Config& config, const std::vector<LookEntry>& entries) {
  std::string clashes;
  for (const LookEntry& entry : entries) {
    const char* name = entry.name.c_str();
    bool clash = config.getLook(name) || config.getColorSpace(name);
    for (int d = 0; d < config.getNumDisplaysAll(); ++d) {
      const char* display = config.getDisplayAll(d);
      for (int v = 0; v < config.getNumViews(OCIO::VIEW_DISPLAY_DEFINED, display); ++v)
        clash |= entry.view && entry.name == config.getView(OCIO::VIEW_DISPLAY_DEFINED, display, v);
    }
    if (clash) clashes += (clashes.empty() ? "'" : ", '") + entry.name + "'";
  }
  if (!clashes.empty())
    throw Error(ExitCode::config, "",
                "the config has looks, colour spaces or views of these names already: " + clashes);
}

/// The folder of the search path that looks' files can go to: the first that is written out and relative.
std::string search_folder(const OCIO::Config& config, const std::string& config_folder) {
  if (config.getNumSearchPaths() == 0) return config_folder;
  for (int i = 0; i < config.getNumSearchPaths(); ++i) {
    const std::string path = config.getSearchPath(i);
    if (path.empty() || path.find('$') != std::string::npos || path.find('%') != std::string::npos) continue;
    if (fs::path(path).is_absolute()) continue;
    return (fs::path(config_folder) / path).string();
  }
  throw Error(ExitCode::config, "",
              "the config's search_path names no folder beside it that LUTs could go to");
}

bool is_picture(const OCIO::Config& config, const std::string& space) {
  const OCIO::ConstColorSpaceRcPtr found = config.getColorSpace(space.c_str());
  return !found || !found->isData();
}

/// Views like the display's first that shows a picture, with each look behind those it has already.
void add_views(OCIO::Config& config, const std::vector<LookEntry>& entries) {
  const OCIO::ConstConfigRcPtr original = config.createEditableCopy();
  for (int d = 0; d < original->getNumDisplaysAll(); ++d) {
    const char* display = original->getDisplayAll(d);
    for (int v = 0; v < original->getNumViews(OCIO::VIEW_DISPLAY_DEFINED, display); ++v) {
      const char* view = original->getView(OCIO::VIEW_DISPLAY_DEFINED, display, v);
      const std::string space = original->getDisplayViewColorSpaceName(display, view);
      if (!is_picture(*original, space)) continue;
      const std::string before = original->getDisplayViewLooks(display, view);
      for (const LookEntry& entry : entries)
        if (entry.view)
          config.addDisplayView(display, entry.name.c_str(),
                                original->getDisplayViewTransformName(display, view), space.c_str(),
                                (before.empty() ? entry.name : before + ", " + entry.name).c_str(), "", "");
      break;
    }
  }
  // A list that is not empty hides every view that it does not name.
  std::string active = config.getActiveViews();
  if (active.empty()) return;
  for (const LookEntry& entry : entries)
    if (entry.view) active += ", " + entry.name;
  config.setActiveViews(active.c_str());
}

}  // namespace

MergedConfig merge_looks(const ColourConfig& config, std::vector<LookEntry> entries) {
  MergedConfig merged;
  const OCIO::ConfigRcPtr edited = config.ocio()->createEditableCopy();
  refuse_clashes(*edited, entries);
  const std::string folder = fs::absolute(config.file()).parent_path().string();
  merged.lut_folder = search_folder(*edited, folder) + "/" + folder_name;
  for (LookEntry& entry : entries)
    if (!entry.file.empty()) entry.file = std::string(folder_name) + "/" + entry.file;
  const LookPlace place = {config.working_space(), reference_space(*edited)};
  const std::string before = serialised(*edited);
  if (edited->getNumLooks() == 0) add_noop_look(*edited, "Photopic", place);
  for (const LookEntry& entry : entries) add_look(*edited, entry, place);
  add_views(*edited, entries);
  const std::string after = config_text(*edited);

  merged.text = inserted(text_of(config.file()), before, after, *edited);
  try {
    std::istringstream in(merged.text);
    const OCIO::ConfigRcPtr read = OCIO::Config::CreateFromStream(in)->createEditableCopy();
    read->setWorkingDir(edited->getWorkingDir());
    merged.rewritten = serialised(*read) != after;
  } catch (const OCIO::Exception&) {
    merged.rewritten = true;
  }
  if (merged.rewritten) merged.text = after;
  return merged;
}

std::string line_diff(const std::string& before, const std::string& after) {
  const Lines a = lines_of(before), b = lines_of(after);
  std::string diff;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      ++i, ++j;
      continue;
    }
    // Up to where the old line goes on, all is new; a line that never comes again was changed or removed.
    diff += fmt::format("@@ -{} +{} @@\n", i + 1, j + 1);
    const auto rest =
        i < a.size() ? std::find(b.begin() + static_cast<std::ptrdiff_t>(j), b.end(), a[i]) : b.end();
    if (i < a.size() && rest == b.end()) {
      diff += "-" + a[i++] + "\n";
      if (j < b.size() && (i >= a.size() || b[j] != a[i])) diff += "+" + b[j++] + "\n";
      continue;
    }
    const auto until = static_cast<std::size_t>(rest - b.begin());
    while (j < until) diff += "+" + b[j++] + "\n";
  }
  return diff;
}

}  // namespace scotopic

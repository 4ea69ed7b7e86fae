#include "looks/merge/config_merge.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/error.h"
#include "color/config/lost_displays.h"
#include "looks/merge/added_views.h"
#include "looks/merge/config_lines.h"
#include "looks/verify/inspect.h"

namespace OCIO = OCIO_NAMESPACE;
namespace fs = std::filesystem;

namespace scotopic {
namespace {

constexpr const char* folder_name = "scotopic";

std::string serialised(const OCIO::Config& config) {
  std::ostringstream text;
  config.serialize(text);
  return text.str();
}

bool has_view(const OCIO::Config& config, const std::string& name) {
  for (int d = -1; d < config.getNumDisplaysAll(); ++d) {
    const char* display = d < 0 ? "" : config.getDisplayAll(d);  // "": the shared views
    for (int v = 0; v < config.getNumViews(OCIO::VIEW_DISPLAY_DEFINED, display); ++v)
      if (name == config.getView(OCIO::VIEW_DISPLAY_DEFINED, display, v)) return true;
  }
  return false;
}

void refuse_clashes(const OCIO::Config& config, const std::vector<LookEntry>& entries) {
  std::string clashes;
  for (const LookEntry& entry : entries) {
    const char* name = entry.name.c_str();
    if (config.getLook(name) || config.getColorSpace(name) || config.getNamedTransform(name) ||
        (entry.view && has_view(config, entry.name)))
      clashes += (clashes.empty() ? "'" : ", '") + entry.name + "'";
  }
  if (!clashes.empty())
    throw Error(ExitCode::config, "",
                "the config has looks, colour spaces or views of these names already: " + clashes);
}

/// The folder of the search path that looks' files can go to: the first that is written out and relative.
std::string search_folder(const OCIO::Config& config, const std::string& config_folder) {
  for (int i = 0; i < config.getNumSearchPaths(); ++i) {
    const std::string path = config.getSearchPath(i);
    if (path.empty() || path.find('$') != std::string::npos || path.find('%') != std::string::npos) continue;
    if (fs::path(path).is_absolute()) continue;
    return (fs::path(config_folder) / path).lexically_normal().string();
  }
  throw Error(ExitCode::config, "",
              "the config's search_path names no folder beside it that LUTs could go to");
}

bool searches_nowhere(const OCIO::Config& config) {
  for (int i = 0; i < config.getNumSearchPaths(); ++i)
    if (*config.getSearchPath(i)) return false;
  return true;
}

OCIO::ConfigRcPtr read(const std::string& text, const OCIO::Config& like) {
  std::istringstream in(text);
  const OCIO::ConfigRcPtr config = OCIO::Config::CreateFromStream(in)->createEditableCopy();
  config->setWorkingDir(like.getWorkingDir());
  forget_lost_displays(*config);
  return config;
}

/// Whether both texts say the same to OCIO.
bool same_reading(const std::string& a, const std::string& b, const OCIO::Config& like) {
  try {
    return same_but_for_rounding(serialised(*read(a, like)), serialised(*read(b, like)));
  } catch (const OCIO::Exception&) {
    return false;
  }
}

/// OCIO's own copy of the config with all that is added, and where that went.
struct Edit {
  OCIO::ConfigRcPtr config;
  AddedViews views;
};

Edit edit(const OCIO::Config& original, const std::string& working_space,
          const std::vector<LookEntry>& entries, MergedConfig& merged) {
  Edit out{original.createEditableCopy(), {}};
  if (searches_nowhere(original)) out.config->setSearchPath(".");
  const LookPlace place = place_beside(original, working_space);
  if (original.getNumLooks() == 0) add_noop_look(*out.config, "Photopic", place);
  for (const LookEntry& entry : entries) add_look(*out.config, entry, place);
  out.views = add_views(*out.config, working_space, entries, merged);
  return out;
}

}  // namespace

MergedConfig merge_looks(const ColourConfig& config, std::vector<LookEntry> entries) {
  MergedConfig merged;
  const OCIO::Config& original = *config.ocio();
  refuse_clashes(original, entries);
  for (LookEntry& entry : entries)
    if (!entry.file.empty()) entry.file = std::string(folder_name) + "/" + entry.file;
  try {
    const Edit edited = edit(original, config.working_space(), entries, merged);
    const std::string folder = fs::absolute(config.file()).parent_path().string();
    merged.lut_folder = (fs::path(search_folder(*edited.config, folder)) / folder_name).string();
    const std::string after = config_text(*edited.config);
    const auto text = with_added_lines(text_of(config.file()), serialised(original), after, edited.views);
    merged.rewritten = !text || !same_reading(*text, after, original);
    merged.text = merged.rewritten ? after : *text;
  } catch (const OCIO::Exception& e) {
    throw Error(ExitCode::config, config.file(), std::string("looks cannot be added: ") + e.what());
  }
  return merged;
}

}  // namespace scotopic

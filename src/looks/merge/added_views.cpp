#include "looks/merge/added_views.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr OCIO::ViewType kinds[] = {OCIO::VIEW_DISPLAY_DEFINED, OCIO::VIEW_SHARED};

/// What a new view takes over.
struct ViewPattern {
  std::string transform, space, looks, rule;
  bool shared = false;

  bool operator<(const ViewPattern& other) const { return key() < other.key(); }
  bool operator==(const ViewPattern& other) const { return key() == other.key(); }

 private:
  std::tuple<const std::string&, const std::string&, const std::string&, const std::string&, const bool&>
  key() const {
    return std::tie(transform, space, looks, rule, shared);
  }
};

std::string text(const char* maybe) { return maybe ? maybe : ""; }

/// The display's name stands for a space called like it.
std::string space_on(const std::string& display, const std::string& space) {
  return space == OCIO::OCIO_VIEW_USE_DISPLAY_NAME ? display : space;
}

bool is_picture(const OCIO::Config& config, const std::string& space) {
  const OCIO::ConstColorSpaceRcPtr found = config.getColorSpace(space.c_str());
  return !found || !found->isData();
}

bool loads(const OCIO::Config& config, const std::string& from, const char* display, const char* view) {
  try {
    (void)config.getProcessor(from.c_str(), display, view, OCIO::TRANSFORM_DIR_FORWARD);
    return true;
  } catch (const OCIO::Exception&) {
    return false;
  }
}

/// The looks of a view; of one that add_views made, which has its own look last, those that were there
/// before.
std::string looks_before_ours(const OCIO::Config& config, const char* display, const std::string& view) {
  const std::string looks = text(config.getDisplayViewLooks(display, view.c_str()));
  const bool ends_so = looks.size() >= view.size() && looks.substr(looks.size() - view.size()) == view;
  // Nobody else names a look, a colour space and a view alike.
  if (!ends_so || !config.getLook(view.c_str()) || !config.getColorSpace(view.c_str())) return looks;
  const std::size_t end = looks.find_last_not_of(", ", looks.size() - view.size() - 1);
  return looks.size() == view.size() || end == std::string::npos ? "" : looks.substr(0, end + 1);
}

/// What a display's first view of a picture is like that loads; where none does (LUTs may be on another
/// machine, or wait for a context), what the first is like.
struct FirstView {
  std::optional<ViewPattern> pattern;
  bool loads = false;
};

FirstView first_view(const OCIO::Config& config, const std::string& from, const char* display) {
  FirstView out;
  for (const OCIO::ViewType kind : kinds)
    for (int v = 0; v < config.getNumViews(kind, display); ++v) {
      const char* view = config.getView(kind, display, v);
      const std::string space = text(config.getDisplayViewColorSpaceName(display, view));
      if (!is_picture(config, space_on(display, space))) continue;
      const bool usable = loads(config, from, display, view);
      if (out.pattern && !usable) continue;
      out.pattern = {text(config.getDisplayViewTransformName(display, view)), space,
                     looks_before_ours(config, display, view), text(config.getDisplayViewRule(display, view)),
                     kind == OCIO::VIEW_SHARED};
      out.loads = usable;
      if (usable) return out;
    }
  return out;
}

/// The shared one of the most displays, of more than one.
std::optional<ViewPattern> common_pattern(const std::map<std::string, ViewPattern>& patterns) {
  std::map<ViewPattern, int> counts;
  for (const auto& [display, pattern] : patterns) counts[pattern] += pattern.shared ? 1 : 0;
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most != counts.end() && most->second > 1 ? std::optional(most->first) : std::nullopt;
}

std::string looks_with(const ViewPattern& pattern, const std::string& look) {
  return pattern.looks.empty() ? look : pattern.looks + ", " + look;
}

void add_own_view(OCIO::Config& config, const std::string& display, const ViewPattern& pattern,
                  const std::string& name) {
  config.addDisplayView(display.c_str(), name.c_str(), pattern.transform.c_str(),
                        space_on(display, pattern.space).c_str(), looks_with(pattern, name).c_str(),
                        pattern.rule.c_str(), "");
}

/// A list that is not empty hides every view that it does not name.
std::vector<std::string> lengthen_active_views(OCIO::Config& config, const std::vector<std::string>& names) {
  std::string active = config.getActiveViews();
  if (active.empty()) return {};
  for (const std::string& name : names) active += ", " + name;
  config.setActiveViews(active.c_str());
  return names;
}

}  // namespace

AddedViews add_views(OCIO::Config& config, const std::string& working_space,
                     const std::vector<LookEntry>& entries, MergedConfig& merged) {
  AddedViews out;
  std::map<std::string, ViewPattern> patterns;
  for (int d = 0; d < config.getNumDisplaysAll(); ++d) {
    const std::string display = config.getDisplayAll(d);
    out.displays.push_back(display);
    const FirstView first = first_view(config, working_space, display.c_str());
    if (first.pattern) patterns[display] = *first.pattern;
    if (first.pattern && !first.loads) merged.unproven_displays.push_back(display);
  }
  std::vector<std::string> names;
  for (const LookEntry& entry : entries)
    if (entry.view) names.push_back(entry.name);
  const std::optional<ViewPattern> common = common_pattern(patterns);
  for (const std::string& name : names)
    if (common)
      config.addSharedView(name.c_str(), common->transform.c_str(), common->space.c_str(),
                           looks_with(*common, name).c_str(), common->rule.c_str(), "");
  for (const auto& [display, pattern] : patterns)
    for (const std::string& name : names) {
      if (!std::count(merged.unproven_displays.begin(), merged.unproven_displays.end(), display))
        merged.views.push_back({display, name});
      if (common && pattern == *common) {
        config.addDisplaySharedView(display.c_str(), name.c_str());
        out.shared[display].push_back(name);
      } else {
        add_own_view(config, display, pattern, name);
      }
    }
  if (!patterns.empty()) out.active = lengthen_active_views(config, names);
  return out;
}

}  // namespace scotopic

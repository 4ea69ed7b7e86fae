// A config's text with lines put into it: comments, order and layout stay as their author has them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scotopic {

/// What goes into a config, beside looks and colour spaces.
struct AddedViews {
  std::vector<std::string> displays;  ///< all of the config
  std::map<std::string, std::vector<std::string>>
      shared;                       ///< display -> shared views that it lists from now on
  std::vector<std::string> active;  ///< longer active_views; empty: the list stays
};

/// `user` with what OpenColorIO's own text `after` has and its text `before` has not: items of colorspaces,
/// looks, shared_views and displays, and search_path; nullopt where the layout of `user` is not understood
/// (flow style for whole lists). Whether it reads as `after` is for the caller to see.
std::optional<std::string> with_added_lines(const std::string& user, const std::string& before,
                                            const std::string& after, const AddedViews& views);

/// Whether two texts of OpenColorIO's are the same, numbers to 1e-12: yaml-cpp 0.9 writes some doubles
/// otherwise once they have been read back.
bool same_but_for_rounding(const std::string& a, const std::string& b);

}  // namespace scotopic

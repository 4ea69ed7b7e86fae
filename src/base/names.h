// Names in sentences: lists of them, and those closest to one that does not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scotopic {

/// At most `limit` of `candidates`, closest first, whose edit distance from `name` (letter case aside) is at
/// most a third of its length, or that contain it.
std::vector<std::string> close_names(std::string_view name, const std::vector<std::string>& candidates,
                                     std::size_t limit = 3);

/// "; did you mean A, B?", or nothing where no candidate is close.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

/// "A" becomes "A, B".
void add_to_list(std::string& list, std::string_view name);
/// "A, B, C".
std::string joined(const std::vector<std::string>& names);

}  // namespace scotopic

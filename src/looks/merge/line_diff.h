// What changed in a text, for people.
#pragma once

#include <string>

namespace scotopic {

/// Unified diff without context; `before` and `after` differ by insertions and changed lines only.
std::string line_diff(const std::string& before, const std::string& after);

}  // namespace scotopic

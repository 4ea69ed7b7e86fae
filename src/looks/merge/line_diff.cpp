#include "looks/merge/line_diff.h"

#include <fmt/format.h>

#include <algorithm>

#include "looks/merge/yaml_block.h"

namespace scotopic {

std::string line_diff(const std::string& before, const std::string& after) {
  const Lines a = lines_of(before), b = lines_of(after);
  std::string diff;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      ++i;
      ++j;
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

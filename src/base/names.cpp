#include "base/names.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace scotopic {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// Levenshtein distance, one row of the table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> close_names(std::string_view name, const std::vector<std::string>& candidates,
                                     std::size_t limit) {
  // Longer names are typing accidents of nothing; comparing them would only cost time.
  if (name.empty() || name.size() > 256) return {};
  struct Scored {
    std::size_t distance;
    const std::string* candidate;
  };
  std::vector<Scored> close;
  const std::string wanted = lower(name);
  for (const std::string& candidate : candidates) {
    const std::string have = lower(candidate);
    const std::size_t distance = edit_distance(wanted, have);
    const bool contained = wanted.size() >= 3 && have.find(wanted) != std::string::npos;
    if (contained || distance <= std::max<std::size_t>(1, wanted.size() / 3))
      close.push_back({distance, &candidate});
  }
  std::stable_sort(close.begin(), close.end(),
                   [](const Scored& a, const Scored& b) { return a.distance < b.distance; });
  std::vector<std::string> out;
  for (std::size_t i = 0; i < std::min(limit, close.size()); ++i) out.push_back(*close[i].candidate);
  return out;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  const std::vector<std::string> close = close_names(name, candidates);
  if (close.empty()) return "";
  return "; did you mean " + joined(close) + "?";
}

void add_to_list(std::string& list, std::string_view name) {
  if (!list.empty()) list += ", ";
  list += name;
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) add_to_list(out, name);
  return out;
}

}  // namespace scotopic

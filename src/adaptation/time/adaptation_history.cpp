// The text form of an adaptation history.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "adaptation/time/dark_adaptation.h"
#include "adaptation/named_adaptations.h"

namespace scotopic {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// Takes what stands before the first of `ends`; what follows stays in `text`.
std::string_view cut(std::string_view& text, std::string_view ends) {
  const std::size_t end = std::min(text.find_first_of(ends), text.size());
  const std::string_view piece = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return piece;
}

std::optional<double> number(std::string_view text) {
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x) || x < 0)
    return std::nullopt;
  return x;
}

std::optional<AdaptationPeriod> period(std::string_view entry) {
  const std::size_t colon = entry.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string_view light = trimmed(entry.substr(0, colon));
  const std::optional<double> named = named_adaptation(light);
  const std::optional<double> luminance = named ? named : number(light);
  const std::optional<double> seconds = number(trimmed(entry.substr(colon + 1)));
  if (!luminance || !seconds) return std::nullopt;
  return AdaptationPeriod{*luminance, *seconds};
}

}  // namespace

AdaptationHistory parse_adaptation_history(std::string_view text) {
  AdaptationHistory history;
  while (!text.empty()) {
    std::string_view line = cut(text, "\n");
    for (line = cut(line, "#"); !line.empty();) {
      const std::string_view entry = trimmed(cut(line, ","));
      if (entry.empty()) continue;
      const std::optional<AdaptationPeriod> read = period(entry);
      if (!read)
        return {{},
                "'" + std::string(entry) + "' is not La:seconds (cd/m2 or a name, and s, neither below 0)"};
      history.periods.push_back(*read);
    }
  }
  if (history.periods.empty()) history.problem = "no La:seconds";
  return history;
}

}  // namespace scotopic

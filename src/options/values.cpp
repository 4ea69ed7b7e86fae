#include "options/values.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

#include "adaptation/named_adaptations.h"

namespace scotopic {

CLI::Validator whole_number(std::int64_t least, std::int64_t greatest) {
  const std::string range = fmt::format("{} to {}", least, greatest);
  const auto check = [=](const std::string& text) {
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool plain = !text.empty() && text[0] != '-' && (text[0] != '0' || text.size() == 1);
    const bool good = plain && error == std::errc() && stop == end && value >= least && value <= greatest;
    return good ? std::string() : fmt::format("'{}' is not a whole number from {}", text, range);
  };
  return CLI::Validator(check, range);
}

std::optional<double> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void fail_value(const char* option, const std::string& text, const std::string& takes) {
  throw Error(ExitCode::usage, "", std::string(option) + ": '" + text + "' is not " + takes);
}

double number_in(const char* option, const std::string& text, double least, double greatest,
                 const char* takes) {
  const std::optional<double> value = parse_number(text);
  if (!value || !(*value >= least) || !(*value <= greatest)) fail_value(option, text, takes);
  return *value;
}

double luminance_value(const char* option, const std::string& text) {
  return number_in(option, text, 1e-9, 1e9, "a luminance in cd/m2 (a number above 0, from 1e-9 to 1e9)");
}

double adaptation_value(const std::string& text) {
  if (const std::optional<double> named = named_adaptation(text)) return *named;
  const bool word =
      !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) && text != "nan" && text != "inf";
  if (!word) return luminance_value("--adaptation", text);
  std::vector<std::string> names = {"auto"};
  for (const NamedAdaptation& step : named_adaptations) names.emplace_back(step.name);
  fail_value("--adaptation", text,
             "a luminance in cd/m2, or a name (explain --adaptations)" + did_you_mean(text, names));
}

}  // namespace scotopic

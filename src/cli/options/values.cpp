#include "cli/options/values.h"

#include <charconv>
#include <cmath>

namespace scotopic {

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

}  // namespace scotopic

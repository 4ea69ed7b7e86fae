#include "options/scene/adaptation_method.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "options/values.h"

namespace scotopic {
namespace {

constexpr const char* takes = "auto, auto:median, auto:p1 to auto:p99, or auto:X,Y,W,H (a region of pixels)";

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

AdaptationMethod percentile(const std::string& text, const std::string& number) {
  const double percent = number_in("--adaptation", number, 1, 99, takes);
  AdaptationMethod method;
  method.quantile = percent / 100;
  method.description =
      text == "median" ? "median of the picture" : fmt::format("percentile {} of the picture", percent);
  return method;
}

AdaptationMethod region(const std::string& text, const std::vector<std::string>& parts) {
  int values[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const double value = number_in("--adaptation", parts[i], i < 2 ? -1e9 : 1, 1e9, takes);
    if (value != std::floor(value)) fail_value("--adaptation", text, takes);
    values[i] = static_cast<int>(value);
  }
  AdaptationMethod method;
  method.region = Window{values[0], values[1], values[0] + values[2], values[1] + values[3]};
  method.description = "log-average of region " + text;
  return method;
}

}  // namespace

std::optional<AdaptationMethod> parse_adaptation_method(const std::string& text) {
  if (text == "auto") return AdaptationMethod();
  if (text.rfind("auto:", 0) != 0) return std::nullopt;
  const std::string method = text.substr(5);
  if (method == "median") return percentile(method, "50");
  if (method.size() > 1 && method[0] == 'p') return percentile(method, method.substr(1));
  const std::vector<std::string> parts = split(method, ',');
  if (parts.size() != 4) fail_value("--adaptation", text, takes);
  return region(method, parts);
}

}  // namespace scotopic

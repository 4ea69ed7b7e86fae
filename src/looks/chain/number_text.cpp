#include "looks/chain/number_text.h"

#include <fmt/format.h>

namespace scotopic {

std::string number_text(float value) { return fmt::format("{}", value); }

std::string number_text(double value) { return fmt::format("{}", value); }

std::string fixed_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string rounded_text(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

}  // namespace scotopic

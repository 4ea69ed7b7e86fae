// Option values from text: locale-free, whole, finite; an Error(usage) names option, value and what it takes.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/names.h"

namespace scotopic {

/// A whole number in decimal digits alone: no sign, space, leading zero or prefix, which CLI11 takes for
/// octal or hexadecimal.
CLI::Validator whole_number(std::int64_t least, std::int64_t greatest);

/// Adds options that are read as text, in one group of a verb's help.
struct TextOptions {
  CLI::App& verb;
  std::string group = "Options";  // CLI11's own

  CLI::Option* operator()(const std::string& name, std::string& value, const std::string& text,
                          const std::string& kind) const {
    return verb.add_option(name, value, text)->type_name(kind)->group(group);
  }
};

/// A finite decimal number and nothing after it.
std::optional<double> parse_number(std::string_view text);

/// A number in [least, greatest]; `takes` says so in words.
double number_in(const char* option, const std::string& text, double least, double greatest,
                 const char* takes);

/// A luminance, cd/m2: 1e-9 to 1e9.
double luminance_value(const char* option, const std::string& text);
/// The value of --adaptation where it is not metered: cd/m2, or a name of the ladder.
double adaptation_value(const std::string& text);

[[noreturn]] void fail_value(const char* option, const std::string& text, const std::string& takes);

/// The value of one of `names`.
template <typename T>
T choice(const char* option, const std::string& text, const std::vector<std::pair<std::string, T>>& names) {
  std::vector<std::string> known;
  for (const auto& [name, value] : names) {
    if (name == text) return value;
    known.push_back(name);
  }
  fail_value(option, text, "one of " + joined(known) + did_you_mean(text, known));
}

}  // namespace scotopic

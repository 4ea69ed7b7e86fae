// The operator's parameters: by name, each a text in the words of the program's options. Names, groups,
// defaults and sentences are those of the options of apply.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace scotopic {

/// "white_luminance" -> "10", as --white-luminance 10. What is not there has its default.
using Parameters = std::map<std::string, std::string>;

/// One that a host may give.
struct ParameterInfo {
  std::string name;      ///< of an option, without dashes in front, _ for -
  std::string option;    ///< as the program has it
  std::string group;     ///< its heading in the help
  std::string takes;     ///< a word for what it takes: CDM2, X, NAME ...
  std::string sentence;  ///< what it does
};

/// All of them, in the order of the help. Options about files, parts of files, and limits of them are none.
const std::vector<ParameterInfo>& parameter_list();

}  // namespace scotopic

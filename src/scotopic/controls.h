// The parameters as controls of a host's panel: sliders, menus, texts. Ranges are those of the stages' own
// descriptions; of the others they are listed here.
#pragma once

#include <string>
#include <vector>

namespace scotopic {

/// A control. At its initial value nothing is asked for: the program's default holds.
struct Control {
  enum class Kind { number, word, text };
  std::string name;  ///< of the parameter; see parameters.h
  std::string group;
  std::string sentence;
  Kind kind = Kind::text;
  double low = 0, high = 0, initial = 0;  ///< of a number; of a word its place
  std::vector<std::string> words;
};

/// All but adaptation and effects, which hosts show in ways of their own, and what no panel should have
/// (config, limits, older names).
const std::vector<Control>& controls();

/// The text of a number, as parameters take it: the shortest that is read as the same.
std::string parameter_text(double value);

}  // namespace scotopic

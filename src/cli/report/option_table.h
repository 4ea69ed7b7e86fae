// The program's verbs and options as data: what man pages and shell completions are written from.
#pragma once

#include <string>
#include <vector>

#include "cli/program.h"

namespace scotopic {

struct OptionRow {
  std::string short_name;  ///< "-o", or empty
  std::string long_name;   ///< "--output", or empty
  std::string kind;        ///< what it takes, "FILE"; empty for a flag
  std::string text;
  std::string preset;      ///< default, where help shows one
  std::string group;
  std::vector<std::string> values;  ///< all that it takes, where these can be listed
  bool required = false;

  bool names_file() const;
  std::string name() const { return long_name.empty() ? short_name : long_name; }
};

struct VerbRow {
  std::string name;
  std::string text;
  std::string footer;
  std::vector<OptionRow> arguments;  ///< without a dash
  std::vector<OptionRow> options;
};

/// Every verb, from the options that it adds itself. Values are those that the verb names when it refuses one.
std::vector<VerbRow> option_table(const std::vector<AddVerb>& verbs);

/// scotopic-VERB(1), or for no verb scotopic(1), in man(7).
std::string man_page(const VerbRow& verb);
std::string man_page(const std::vector<VerbRow>& verbs);

/// Completion scripts.
std::string bash_completion(const std::vector<VerbRow>& verbs);
std::string zsh_completion(const std::vector<VerbRow>& verbs);
std::string fish_completion(const std::vector<VerbRow>& verbs);

}  // namespace scotopic

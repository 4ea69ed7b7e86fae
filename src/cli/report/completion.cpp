// Completion scripts from the option table. Values that name files are left to the shell, which knows how to quote them.
#include "cli/report/option_table.h"

namespace scotopic {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::vector<std::string> names(const OptionRow& row) {
  std::vector<std::string> out;
  for (const std::string& name : {row.short_name, row.long_name})
    if (!name.empty()) out.push_back(name);
  return out;
}

std::string verb_names(const std::vector<VerbRow>& verbs) {
  std::vector<std::string> all;
  for (const VerbRow& verb : verbs) all.push_back(verb.name);
  return joined(all);
}

std::string escaped(const std::string& text, const std::string& special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != special.npos) out += '\\';
    out += c;
  }
  return out;
}

/// A word in single quotes, for zsh, whose '' is two words put together.
std::string in_quotes(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string bash_completion(const std::vector<VerbRow>& verbs) {
  std::string out =
      "# bash completion for scotopic; made from the program's own options: edit those.\n"
      "_scotopic() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options= values=\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    COMPREPLY=($(compgen -W '" + verb_names(verbs) + " --help --version' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${COMP_WORDS[1]} in\n";
  for (const VerbRow& verb : verbs) {
    std::vector<std::string> all, others;
    std::string cases;
    for (const OptionRow& row : verb.options) {
      const std::vector<std::string> own = names(row);
      all.insert(all.end(), own.begin(), own.end());
      std::string pattern;
      for (const std::string& name : own) pattern += (pattern.empty() ? "" : "|") + name;
      if (!row.values.empty()) cases += "        " + pattern + ") values='" + joined(row.values) + "' ;;\n";
      else if (row.names_file()) cases += "        " + pattern + ") return ;;\n";
      else if (!row.kind.empty()) others.push_back(pattern);
    }
    std::string nothing;
    for (const std::string& pattern : others) nothing += (nothing.empty() ? "" : "|") + pattern;
    out += "    " + verb.name + ")\n      options='" + joined(all) + "'\n      case $before in\n" + cases;
    // An empty word that nothing matches: no file is offered where a number is wanted.
    if (!nothing.empty()) out += "        " + nothing + ") compopt +o default; return ;;\n";
    out += "      esac ;;\n";
  }
  return out +
         "  esac\n"
         "  if [[ -n $values ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$values\" -- \"$word\"))\n"
         "  elif [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -o default -F _scotopic scotopic\n";
}

std::string zsh_completion(const std::vector<VerbRow>& verbs) {
  std::string out =
      "#compdef scotopic\n# Made from the program's own options: edit those.\n"
      "_scotopic() {\n  if ((CURRENT == 2)); then\n    local -a verbs=(\n";
  for (const VerbRow& verb : verbs) out += "      " + in_quotes(verb.name + ":" + escaped(verb.text, ":\\")) + "\n";
  out += "    )\n    _describe verb verbs\n    return\n  fi\n  local verb=$words[2]\n  shift words\n  ((CURRENT--))\n  case $verb in\n";
  for (const VerbRow& verb : verbs) {
    out += "    " + verb.name + ")\n      _arguments";
    for (const OptionRow& row : verb.options)
      for (const std::string& name : names(row)) {
        std::string spec = name + "[" + escaped(row.text, "[]:\\") + "]";
        if (!row.kind.empty()) spec += ":" + escaped(row.kind, ":\\") + ":";
        if (!row.values.empty()) spec += "(" + joined(row.values) + ")";
        else if (row.names_file()) spec += "_files";
        out += " \\\n        " + in_quotes(spec);
      }
    out += " \\\n        '*:file:_files' ;;\n";
  }
  return out + "  esac\n}\n_scotopic \"$@\"\n";
}

std::string fish_completion(const std::vector<VerbRow>& verbs) {
  std::string out = "# fish completion for scotopic; made from the program's own options: edit those.\n";
  for (const VerbRow& verb : verbs)
    out += "complete -c scotopic -n __fish_use_subcommand -f -a " + verb.name + " -d '" + escaped(verb.text, "'\\") + "'\n";
  for (const VerbRow& verb : verbs)
    for (const OptionRow& row : verb.options) {
      out += "complete -c scotopic -n '__fish_seen_subcommand_from " + verb.name + "'";
      if (!row.short_name.empty()) out += " -s " + row.short_name.substr(1);
      if (!row.long_name.empty()) out += " -l " + row.long_name.substr(2);
      if (!row.values.empty()) out += " -x -a '" + joined(row.values) + "'";
      else if (!row.kind.empty()) out += row.names_file() ? " -r" : " -x";
      out += " -d '" + escaped(row.text, "'\\") + "'\n";
    }
  return out;
}

}  // namespace scotopic

#include "host/parameters.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/names.h"

namespace scotopic {
namespace {

/// About files, which a host that holds pixels has not.
const std::set<std::string>& of_files() {
  static const std::set<std::string> names = {"--bands",        "--band-radiance", "--receptor-channels",
                                              "--layer",        "--max-side",      "--max-pixels",
                                              "--max-channels", "--max-bands"};
  return names;
}

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

void add_options(CLI::App& app, ApplyOptions& o) {
  app.set_help_flag();
  add_scene_options(app, o.scene);
  add_apply_options(app, o);
  add_input_options(app, o.scene.image);
  add_output_options(app, o.scene.image);
}

/// "--name", or empty for an option that is none of a host's.
std::string long_name(const CLI::Option& option) {
  if (option.get_lnames().empty()) return "";
  std::string name = "--" + option.get_lnames().front();
  return of_files().count(name) != 0 ? "" : name;
}

std::vector<ParameterInfo> list() {
  ApplyOptions options;
  CLI::App app;
  add_options(app, options);
  std::vector<ParameterInfo> out;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = long_name(*option);
    if (name.empty()) continue;
    out.push_back({replaced(name.substr(2), '-', '_'), name, option->get_group(), option->get_type_name(),
                   option->get_description()});
  }
  return out;
}

const ParameterInfo& info_of(const std::string& name) {
  std::vector<std::string> names;
  for (const ParameterInfo& info : parameter_list()) {
    if (info.name == name) return info;
    names.push_back(info.name);
  }
  throw Error(ExitCode::usage, "", "unknown parameter '" + name + "'" + did_you_mean(name, names));
}

}  // namespace

const std::vector<ParameterInfo>& parameter_list() {
  static const std::vector<ParameterInfo> all = list();
  return all;
}

ApplyOptions options_of(const Parameters& parameters) {
  ApplyOptions out;
  CLI::App app;
  add_options(app, out);
  std::vector<std::string> words;
  for (const auto& [name, value] : parameters) {
    const std::string& option = info_of(name).option;
    if (value.empty()) throw Error(ExitCode::usage, "", option + ": '' is not a value: it is empty");
    words.push_back(option + "=" + value);
  }
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    throw Error(ExitCode::usage, "", error.what());
  }
  return out;
}

}  // namespace scotopic

#include "cli/report/option_table.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

namespace scotopic {
namespace {

/// Kinds of values that are one of a list, and commands that go as far as to look at them.
constexpr std::array<std::string_view, 3> listed_kinds = {"NAME", "TYPE", "WHAT"};
std::vector<std::string> command_of(const std::string& verb) {
  if (verb == "apply" || verb == "lmsr") return {verb, "no/such/file", "-o", "no/such/folder/out.exr"};
  if (verb == "explain") return {verb, "no/such/file"};
  if (verb == "bake") return {verb, "-o", "no/such/folder/out.clf", "--adaptation", "1"};
  return {};
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(by, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + by.size();
  }
  return parts;
}

/// What the program itself names when it is given a value that it cannot know.
std::vector<std::string> values_of(const std::vector<AddVerb>& verbs, const std::string& verb, const OptionRow& row) {
  std::vector<std::string> words = command_of(verb);
  if (words.empty() || std::find(listed_kinds.begin(), listed_kinds.end(), row.kind) == listed_kinds.end()) return {};
  words.insert(words.end(), {row.name(), "?"});
  std::reverse(words.begin(), words.end());
  CLI::App program("", "scotopic");
  Invocation invocation;
  for (const AddVerb add : verbs) add(program, invocation);
  try {
    program.parse(words);
    (void)invocation.run();
  } catch (const Error& error) {
    const std::string what = error.what(), before = row.name() + ": '?' is not one of ";
    if (what.rfind(before, 0) == 0) return split(what.substr(before.size()), ", ");
  } catch (const CLI::Error&) {
  }
  return {};
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  if (!option.get_snames().empty()) row.short_name = "-" + option.get_snames().front();
  if (!option.get_lnames().empty()) row.long_name = "--" + option.get_lnames().front();
  if (option.get_items_expected_max() > 0) row.kind = option.get_type_name();
  row.text = option.get_description();
  row.preset = option.get_default_str();
  row.group = option.get_group();
  row.required = option.get_required();
  return row;
}

}  // namespace

bool OptionRow::names_file() const {
  for (const char* word : {"FILE", "IN", "OUT", "DIR", "CONFIG"})
    if (kind.find(word) != kind.npos) return true;
  return false;
}

std::vector<VerbRow> option_table(const std::vector<AddVerb>& verbs) {
  CLI::App program("", "scotopic");
  Invocation invocation;
  for (const AddVerb add : verbs) add(program, invocation);
  std::vector<VerbRow> table;
  for (const CLI::App* app : program.get_subcommands([](const CLI::App*) { return true; })) {
    VerbRow verb{app->get_name(), app->get_description(), app->get_footer(), {}, {}};
    for (const CLI::Option* option : app->get_options()) {
      OptionRow row = row_of(*option);
      if (option->get_positional()) {
        verb.arguments.push_back(row);
      } else if (!row.group.empty()) {
        row.values = values_of(verbs, verb.name, row);
        verb.options.push_back(row);
      }
    }
    table.push_back(std::move(verb));
  }
  return table;
}

}  // namespace scotopic

#include "cli/program.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/process.h"
#include "base/names.h"

namespace scotopic {
namespace {

/// What people call an option elsewhere, or in papers.
std::string other_name_of(const std::string& option, const std::vector<std::string>& known) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"--la", "--adaptation"},         {"--luminance-adaptation", "--adaptation"},
      {"--white", "--white-luminance"}, {"--unit", "--white-luminance"},
      {"--view", "--display"},          {"--lut", "--look"},
      {"--quality", "--precision"},     {"--in-colorspace", "--colorspace"},
      {"--frame", "--frames"}};
  for (const auto& [other, name] : names)
    if (option == other && std::find(known.begin(), known.end(), name) != known.end())
      return "; did you mean " + std::string(name) + "?";
  return did_you_mean(option, known);
}

/// A long option or verb that does not exist, with what it may have been; empty if that is not what is wrong.
std::string unknown_name(const CLI::App& program, int argc, char** argv) {
  const CLI::App* verb = nullptr;
  for (const CLI::App* v : program.get_subcommands([](const CLI::App*) { return true; }))
    if (argc > 1 && v->get_name() == argv[1]) verb = v;
  std::vector<std::string> names;
  if (!verb && argc > 1 && argv[1][0] != '-') {
    for (const CLI::App* v : program.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(v->get_name());
    return std::string("unknown verb '") + argv[1] + "'" + did_you_mean(argv[1], names);
  }
  const CLI::App& app = verb ? *verb : program;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--") break;
    const std::string name(argument.substr(0, argument.find('=')));
    if (name.rfind("--", 0) == 0 && std::find(names.begin(), names.end(), name) == names.end())
      return "unknown option '" + name + "'" + other_name_of(name, names);
  }
  return "";
}

Error usage_error(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
  const std::string unknown = unknown_name(program, argc, argv);
  return Error(ExitCode::usage, "", unknown.empty() ? error.what() : unknown);
}

/// A value that is there, but empty, is a mistake of a script's, and no wish for the default.
void refuse_empty_values(const CLI::App& program) {
  for (const CLI::App* verb : program.get_subcommands())
    for (const CLI::Option* option : verb->get_options()) {
      // Of those that would take it for their default; the others say themselves what they take.
      if (option->get_positional() || option->get_name() == "--adaptation") continue;
      for (const std::string& value : option->results())
        if (value.empty())
          throw Error(ExitCode::usage, "", option->get_name() + ": '' is not a value: it is empty");
    }
}

bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const char* a) { return std::string_view(a) == "--json"; });
}

/// What a program writes and does not get rid of is not said.
void check_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw Error(ExitCode::output, "standard output", "cannot be written");
}

int run_verb(const Invocation& invocation, bool json) {
  try {
    const int code = invocation.run();
    check_stdout();
    return code;
  } catch (...) {
    return report(error_of(std::current_exception()), json);
  }
}

/// The command line with "--acuity local" as "--acuity=local": the option may also stand alone, before a
/// file's name. Last word first, as CLI11 wants a list.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> out;
  for (int i = argc - 1; i > 0; --i) {
    const std::string_view word = argv[i];
    if (std::string_view(argv[i - 1]) == "--acuity" &&
        (word == "local" || word == "global" || word == "off")) {
      out.push_back("--acuity=" + std::string(word));
      --i;
    } else {
      out.emplace_back(word);
    }
  }
  return out;
}

/// Help or the version, on stdout.
int print_wish(const CLI::App& program, const CLI::Success& wish, bool json) {
  const int code = program.exit(wish);
  if (std::cout.flush().good()) return code;
  return report(Error(ExitCode::output, "standard output", "cannot be written"), json);
}

}  // namespace

int run_program(int argc, char** argv, const std::vector<AddVerb>& verbs) {
  const bool json = asks_for_json(argc, argv);
  const Process process(json);
  (void)on_terminal();  // before anything else may close or lend descriptor 2
  CLI::App program("Shows images as the dark-adapted eye sees them: rods, cones, and the way between.",
                   "scotopic");
  program.set_version_flag("--version", "scotopic " SCOTOPIC_VERSION);
  program.require_subcommand(1);
  Invocation invocation;
  for (const AddVerb add : verbs) add(program, invocation);
  if (argc <= 1) {
    std::fputs(program.help().c_str(), stdout);
    return static_cast<int>(ExitCode::usage);
  }
  try {
    program.parse(arguments_of(argc, argv));
    refuse_empty_values(program);
  } catch (const CLI::Success& wish) {
    return print_wish(program, wish, json);
  } catch (const CLI::ParseError& error) {
    return report(usage_error(program, error, argc, argv), json);
  } catch (const Error& error) {
    return report(error, json);
  }
  return run_verb(invocation, json);
}

}  // namespace scotopic

// The program around its verbs: each adds itself, the command line picks one.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "cli/console.h"
#include "cli/sequence/provenance.h"
#include "pipeline/stages/stage_values.h"

namespace scotopic {

/// What the command line asked for; a verb sets it when it is the one.
struct Invocation {
  std::function<int()> run;
  const CommonOptions* common = nullptr;
  StageTable stages = shipped_stages();  ///< that verbs have options for
};

/// Adds a subcommand with its options and help; on the command line it sets the invocation.
using AddVerb = void (*)(CLI::App& program, Invocation& invocation);

/// Parses, runs, reports; returns the exit code. Never throws.
int run_program(int argc, char** argv, const std::vector<AddVerb>& verbs);

/// Sets the invocation to `run` with these options when the verb is on the command line.
template <typename Options>
void on_command_line(CLI::App& verb, Invocation& invocation, const std::shared_ptr<Options>& options,
                     int (*run)(const Options&)) {
  verb.callback([&verb, &invocation, options, run] {
    options->common.typed = typed_options(verb);
    invocation.common = &options->common;
    invocation.run = [options, run] { return run(*options); };
  });
}

// The verbs, one file each.
void add_apply(CLI::App& program, Invocation& invocation);
void add_lmsr(CLI::App& program, Invocation& invocation);
void add_explain(CLI::App& program, Invocation& invocation);
void add_bake(CLI::App& program, Invocation& invocation);
void add_check(CLI::App& program, Invocation& invocation);
void add_time(CLI::App& program, Invocation& invocation);

}  // namespace scotopic

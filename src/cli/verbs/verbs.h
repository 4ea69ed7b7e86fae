// The program's verbs, one file each, and the run of them: all that main knows.
#pragma once

#include <vector>

namespace CLI {
class App;
}

namespace scotopic {

struct Invocation;

/// Adds a subcommand with its options and help; on the command line it sets the invocation.
using AddVerb = void (*)(CLI::App& program, Invocation& invocation);

void add_apply(CLI::App& program, Invocation& invocation);
void add_lmsr(CLI::App& program, Invocation& invocation);
void add_explain(CLI::App& program, Invocation& invocation);
void add_bake(CLI::App& program, Invocation& invocation);
void add_check(CLI::App& program, Invocation& invocation);
void add_time(CLI::App& program, Invocation& invocation);

/// Parses, runs, reports; returns the exit code. Never throws.
int run_program(int argc, char** argv, const std::vector<AddVerb>& verbs);

}  // namespace scotopic

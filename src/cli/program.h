// What a verb asks of the program: each adds itself, the command line picks one.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "report/console.h"
#include "cli/sequence/provenance.h"
#include "cli/verbs/verbs.h"
#include "pipeline/stages/stage_values.h"

namespace scotopic {

/// What the command line asked for; a verb sets it when it is the one.
struct Invocation {
  std::function<int()> run;
  const CommonOptions* common = nullptr;
  StageTable stages = shipped_stages();  ///< that verbs have options for
};

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

}  // namespace scotopic

// What the program says, and where: results on stdout, everything else one line at a time on stderr.
#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "pipeline/notes.h"

namespace scotopic {

/// Options that every verb has.
struct CommonOptions {
  bool verbose = false;
  bool quiet = false;
  bool json = false;
  int threads = 0;
  /// Options on the command line that change what is written, each as "name=value"; see provenance.h.
  std::vector<std::string> typed;
};

void add_common_options(CLI::App& verb, CommonOptions& options);

/// Control characters, and bytes that are no UTF-8, as escapes, so that no file name can break a line or move
/// the cursor.
std::string printable(const std::string& text);

/// Takes a line that would have gone to stderr.
using LineSink = std::function<void(const std::string& line)>;

/// Several threads may speak at once: lines stay whole.
class Console {
 public:
  /// Notes go to `sink` where there is one.
  explicit Console(const CommonOptions& options, LineSink sink = nullptr)
      : options_(options), sink_(std::move(sink)) {}

  /// What the user should know without asking; silenced by -q. With --json an object of its own.
  void note(const std::string& text) const;
  /// Only with -v.
  void detail(const std::string& text) const;
  /// With --json: the verb's result, as one line on stdout.
  void result(const nlohmann::ordered_json& object) const;
  /// For the pipeline's; while the console is there.
  Notes notes() const;
  bool json() const noexcept { return options_.json; }
  const CommonOptions& options() const noexcept { return options_; }

 private:
  void line(const std::string& text) const;

  CommonOptions options_;
  LineSink sink_;
};

/// Whether stderr is a terminal, where a line can be drawn over.
bool on_terminal();
/// Columns of it.
int terminal_columns();
/// Draws a line on the terminal that stays below whatever else is said; "" takes it away.
void show_status(const std::string& line);

/// "scotopic: FILE: what (nothing written)", or how many files had been; with `json` an object that says the
/// same; returns the exit code.
int report(const Error& error, bool json);

/// What is told of a failure: an Error as it is, anything else as a limit (no memory) or as internal.
Error error_of(const std::exception_ptr& failure);

}  // namespace scotopic

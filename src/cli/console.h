// What the program says, and where: results on stdout, everything else one line at a time on stderr.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "image/error.h"

namespace scotopic {

/// Options that every verb has.
struct CommonOptions {
  bool verbose = false;
  bool quiet = false;
  bool json = false;
  int threads = 0;
};

void add_common_options(CLI::App& verb, CommonOptions& options);

/// Control characters, and bytes that are no UTF-8, as escapes, so that no file name can break a line or move
/// the cursor.
std::string printable(const std::string& text);

class Console {
 public:
  explicit Console(const CommonOptions& options) : options_(options) {}

  /// What the user should know without asking; silenced by -q. With --json an object of its own.
  void note(const std::string& text) const;
  /// Only with -v.
  void detail(const std::string& text) const;
  /// With --json: the verb's result, as one line on stdout.
  void result(const nlohmann::ordered_json& object) const;
  bool json() const noexcept { return options_.json; }

 private:
  void line(const std::string& text) const;

  CommonOptions options_;
};

/// "scotopic: FILE: what (nothing written)", or how many files had been; with `json` an object that says the
/// same; returns the exit code.
int report(const Error& error, bool json);

}  // namespace scotopic

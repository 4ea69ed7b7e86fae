// Failure, as the caller of a verb sees it: which file, what is wrong, and the exit code that says whose
// fault.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace scotopic {

/// What the program ends with; a signal n ends it with 128 + n.
enum class ExitCode : int {
  done = 0,
  check_failed = 1,
  usage = 2,
  input = 3,
  limit = 4,
  output = 5,
  config = 6,  ///< OCIO config, colour space or LUT
  internal = 70,
};

/// `file` may be empty where no file is at fault; `what()` is one sentence without full stop.
class Error : public std::runtime_error {
 public:
  /// Whose fault, which file, what.
  Error(ExitCode code, std::string file, const std::string& what)
      : std::runtime_error(what), code_(code), file_(std::move(file)) {}

  /// What the program should end with.
  ExitCode code() const noexcept { return code_; }
  /// The file at fault, or empty.
  const std::string& file() const noexcept { return file_; }

 private:
  ExitCode code_;
  std::string file_;
};

}  // namespace scotopic

// Runs the program on thousands of inputs, many in one process.
#pragma once

#include <string>
#include <vector>

namespace scotopic::test {

/// What one of many runs came to.
struct OneOfMany {
  int exit_code = 0;      ///< 128 + n if signal n ended the process (24 and 27: after 5 s of processor time)
  std::string err;        ///< lines parted by tabs
  bool one_line = false;  ///< it said one line
};

/// Each command line through the program's own entry, in a process of 1 GiB of address space; 5 s of
/// processor time each. The next process goes on behind one that died.
std::vector<OneOfMany> run_many(const std::vector<std::vector<std::string>>& command_lines);

}  // namespace scotopic::test

// The built program, run while something goes wrong; and what it has left on the disk.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace scotopic::test {

/// A run of the program: where its arguments are, and what goes wrong (tests/faults/shim.cpp says the words).
struct Attempt {
  std::string program = SCOTOPIC_PROGRAM;
  std::vector<std::string> arguments;
  std::vector<std::string> environment;  ///< NAME=value, besides those of the fault
  std::string call, action;              ///< FAULT_CALL, FAULT_DO; empty: no fault
  long at = 1;
  bool sticky = false;
  std::string folder;  ///< FAULT_FOLDER; the run's own where empty
  std::string log;     ///< FAULT_LOG
  bool jail = false;
  long address_space = 0, file_size = 0;  ///< limits in bytes; 0: none
  bool no_size_signal = false;            ///< SIGXFSZ ignored: a write beyond file_size fails (EFBIG)
  int open_files = 0;
  double kill_after = -1;  ///< seconds; then SIGKILL, or
  int kill_signal = 9;
  bool closed_stdout = false;
  std::string standard_output;  ///< a device to write to, in place of a file
};

struct Ended {
  int exit_code = -1;  ///< 128 + n where a signal ended it
  bool by_signal = false;
  std::string out, err;
  double seconds = 0, cpu_seconds = 0;
  std::map<std::string, long> calls;  ///< how many there were, where it ended by itself
};

Ended run(const Attempt& what);

/// Starts it and does not wait; wait_for() does.
int start(const Attempt& what, const std::string& base);
Ended wait_for(int child, const Attempt& what, const std::string& base);

/// Name relative to the folder -> contents ("/": a folder).
using Files = std::map<std::string, std::string>;
Files files_in(const std::string& folder);

/// One way to write: its arguments work in `folder`, which prepare() fills; run twice it gives the same.
struct WritingVerb {
  std::string name;
  std::vector<std::string> arguments;  ///< @ stands for the folder
  std::vector<std::string> old_files;  ///< names of those that are replaced: old contents are "old"
  bool slow = false;
};
const std::vector<WritingVerb>& writing_verbs();
const WritingVerb& verb(const std::string& name);

/// A folder with the verb's inputs and its old files.
void prepare(const WritingVerb& verb, const std::string& folder);
std::vector<std::string> arguments_of(const WritingVerb& verb, const std::string& folder);

/// What must hold after any fault: each file is as `before` or as `after`, whole; none is of another name. A
/// run that says it succeeded has left `after`. Returns what is wrong, empty if nothing.
std::string broken_promise(const Files& now, const Files& before, const Files& after, const Ended& ended);

/// Also that an error is one line on stderr that begins with "scotopic: ", and the exit code one of `codes`.
std::string broken_report(const Ended& ended, const std::vector<int>& codes);

/// A folder of this process's own under the build folder: nothing of ours is ever in /tmp.
std::string work_folder(const std::string& name);

/// Whether SCOTOPIC_FAULTS=long asks for all of it.
bool long_form();

/// One line of the table: printed, and kept for scripts/faults.sh.
void tally(const std::string& fault, long tries, const std::string& expected, const std::string& seen);

}  // namespace scotopic::test

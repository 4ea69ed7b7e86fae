// A fault at every place of a run where it can strike.
#pragma once

#include <string>
#include <vector>

#include "faults/rig.h"

namespace scotopic::test {

/// A verb with what it finds and what it makes of it.
struct Subject {
  const WritingVerb* verb = nullptr;
  std::string folder;
  Files before, after;
  std::map<std::string, long> calls;  ///< of a run without faults

  void reset() const { prepare(*verb, folder); }
};

/// Runs the verb once without a fault; fails the test if that is not what it should be.
Subject subject_of(const WritingVerb& verb);

struct Fault {
  std::string name;          ///< for the table
  std::string call, action;  ///< of the shim
  bool sticky = false;
  std::vector<int> codes = {0, 5};  ///< exit codes that are right
  bool uncatchable = false;         ///< nothing can be done about a hidden temporary or an empty folder, then
  bool loads_libraries =
      false;  ///< that may crash, as long as every file is old or new: exit codes 127 and 139
};

struct Seen {
  long tries = 0, wrong = 0, temporaries = 0;
  std::map<int, long> codes;
};

/// The fault at call 1, 2, ... to the last of them, or evenly spread where there are more than `most`. After
/// each, the promise must hold; and the same command run again without the fault must do its work, and leave
/// nothing.
void sweep(const Subject& subject, const Fault& fault, long most, Seen& seen);

/// "5: 17 x, 0: 3 x; 2 hidden temporaries, gone after the next run"
std::string text_of(const Seen& seen);

}  // namespace scotopic::test

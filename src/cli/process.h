// The process around the program: locale, environment, standard streams, signals, and the last resort.
#pragma once

namespace scotopic {

/// One, before anything else and until main() returns. Numbers have a point in every locale; of the
/// environment only what SECURITY.md lists has effect; descriptors 0 to 2 are open, so that no file of ours
/// can become one of them; signals remove unfinished files; an exception that nobody can catch, and a library
/// that ends the program, end in one line (`json`: one object) and exit code 4 or 70, not in a crash.
class Process {
 public:
  explicit Process(bool json);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
};

}  // namespace scotopic

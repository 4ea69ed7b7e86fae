// Runs the built program, as a user would.
#pragma once

#include <string>
#include <vector>

namespace scotopic::test {

struct Outcome {
  int exit_code = -1;  ///< 128 + n if signal n ended it
  std::string out;
  std::string err;
  long peak_kib = 0;  ///< resident memory
};

/// Of the program's process; 0: none. A program that waits for ever is ended after ten times its seconds.
struct RunLimits {
  unsigned cpu_seconds = 0;
  unsigned long address_space = 0;  ///< bytes
};

/// Arguments after the program's name; no shell in between. $OCIO is unset.
Outcome run_program(const std::vector<std::string>& arguments, const RunLimits& limits = {});

/// A folder of the test's own, emptied.
std::string work_folder();

/// A plain RGB half OpenEXR of ZIP scanlines, values .01 to 1.
void write_picture(const std::string& file, int width, int height);

}  // namespace scotopic::test

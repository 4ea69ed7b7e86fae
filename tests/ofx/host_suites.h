// The six suites of the test's host.
#pragma once

#include <string>
#include <vector>

#include "ofx/api.h"

namespace scotopic::test {

/// Image effect, property, parameter, memory, multi-thread or message, version 1; nullptr: none of these.
const void* suite(ofx::PropertySet host, const char* name, int version);

/// From now on the host lacks it; empty: it has all.
void leave_out_suite(const std::string& name);
/// Messages since the last call.
std::vector<std::string> take_messages();
/// Pieces of the memory suite's memory that nobody has given back.
int memory_in_use();

}  // namespace scotopic::test

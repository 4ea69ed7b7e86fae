// The process around the program: locale, environment, standard streams, signals, and the last resort.
#pragma once

namespace scotopic {

/// Once, before anything else. Numbers have a point in every locale; of the environment only what SECURITY.md
/// lists has effect; descriptors 0 to 2 are open, so that no file of ours can become one of them; signals
/// remove unfinished files; an exception that nobody can catch ends in one line (`json`: one object) and exit
/// code 4 or 70, not in a crash.
void prepare_process(bool json);

}  // namespace scotopic

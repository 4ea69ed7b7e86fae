// How many threads work on rows.
#pragma once

namespace scotopic {

/// For rows and for OpenEXR's chunks, in the whole process; 0: one for each processor.
void set_threads(int count);

/// Of rows, the caller's included.
int threads_in_use();

}  // namespace scotopic

// How a stage is handed threads: it names tasks, the caller runs them.
#pragma once

#include <functional>

namespace scotopic {

/// Runs task(0) ... task(count-1), on any threads in any order, and returns when all are done.
using ParallelFor = std::function<void(int count, const std::function<void(int)>& task)>;

/// One task after the other, on the calling thread.
inline void serial_for(int count, const std::function<void(int)>& task) {
  for (int i = 0; i < count; ++i) task(i);
}

}  // namespace scotopic

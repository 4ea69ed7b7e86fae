#include "pipeline/rows/threads.h"

#include <OpenEXR/ImfThreading.h>
#include <OpenImageIO/thread.h>

#include <algorithm>
#include <thread>

namespace scotopic {

void set_threads(int count) {
  const int threads = count > 0 ? count : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  // The caller works too: pools are the others.
  OIIO::default_thread_pool()->resize(threads - 1);
  Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
}

int threads_in_use() { return OIIO::default_thread_pool()->size() + 1; }

}  // namespace scotopic

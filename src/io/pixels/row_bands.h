// Going over a subimage in bands, and over a band's rows on all threads.
#pragma once

#include <OpenImageIO/parallel.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>

#include "io/subimage.h"

namespace scotopic {

struct ImageLayout;

/// Rows of all subimages that are computed, not copied.
std::int64_t rows_to_write(const ImageLayout& layout);

/// Calls `work(first, last)` for the rows of a band on all threads; exceptions reach the caller.
template <typename Work>
void parallel_rows(int rows, int chunk_rows, Work work) {
  std::exception_ptr failure;
  std::mutex failure_lock;
  // What the pool guarantees anyhow, where ThreadSanitizer can see it: it does not see into OpenImageIO.
  std::atomic<int> begun{0}, ended{0};
  begun.store(1, std::memory_order_release);
  OIIO::parallel_for_chunked(0, rows, chunk_rows, [&](std::int64_t first, std::int64_t last) {
    (void)begun.load(std::memory_order_acquire);
    try {
      work(static_cast<int>(first), static_cast<int>(last));
    } catch (...) {
      const std::lock_guard lock(failure_lock);
      failure = std::current_exception();
    }
    ended.fetch_add(1, std::memory_order_release);
  });
  (void)ended.load(std::memory_order_acquire);
  if (failure) std::rethrow_exception(failure);
}

/// Calls `use(y0, rows)` for the bands of a subimage, the last one first if `descending`.
template <typename Use>
void each_band(const Subimage& subimage, bool descending, Use use) {
  const int step = band_rows(subimage);
  const int count = (subimage.data.height() + step - 1) / step;
  for (int i = 0; i < count; ++i) {
    const int y0 = subimage.data.y0 + (descending ? count - 1 - i : i) * step;
    use(y0, std::min(step, subimage.data.y1 - y0));
  }
}

}  // namespace scotopic

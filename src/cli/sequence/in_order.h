// Work on many things at once, told of one after the other.
#pragma once

#include <cstddef>
#include <functional>

namespace scotopic {

/// Calls work(i) for i from 0 to count - 1, begun in that order by `at_once` threads, so that one reads while
/// another computes or writes; and done(i), on the calling thread, in that order. When done(i) returns false
/// no more are begun; those begun are finished, and done() is called for them too. `work` must not throw.
void in_order(std::size_t count, int at_once, const std::function<void(std::size_t)>& work,
              const std::function<bool(std::size_t)>& done);

}  // namespace scotopic

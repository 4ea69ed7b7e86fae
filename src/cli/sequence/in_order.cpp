#include "cli/sequence/in_order.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace scotopic {
namespace {

/// What the threads share; every member is guarded by the lock.
struct State {
  std::mutex lock;
  std::condition_variable changed;
  std::size_t begun = 0;
  bool stopped = false;
  std::vector<bool> finished;

  void stop() {
    const std::lock_guard guard(lock);
    stopped = true;
  }
};

/// However the caller is left, no thread begins anything new.
struct StopAtEnd {
  State& state;
  ~StopAtEnd() { state.stop(); }
};

void work_on(State& state, const std::function<void(std::size_t)>& work) {
  std::unique_lock guard(state.lock);
  while (!state.stopped && state.begun < state.finished.size()) {
    const std::size_t i = state.begun++;
    guard.unlock();
    work(i);
    guard.lock();
    state.finished[i] = true;
    state.changed.notify_all();
  }
}

}  // namespace

void in_order(std::size_t count, int at_once, const std::function<void(std::size_t)>& work,
              const std::function<bool(std::size_t)>& done) {
  State state;
  state.finished.resize(count);
  std::vector<std::jthread> threads;
  const std::size_t crew = std::min(count, static_cast<std::size_t>(std::max(1, at_once)));
  const StopAtEnd stop{state};
  for (std::size_t t = 0; t < crew; ++t) threads.emplace_back([&] { work_on(state, work); });
  for (std::size_t i = 0; i < count; ++i) {
    {
      std::unique_lock guard(state.lock);
      state.changed.wait(guard, [&] { return state.finished[i] || (state.stopped && i >= state.begun); });
      if (!state.finished[i]) return;
    }
    if (!done(i)) state.stop();
  }
}

}  // namespace scotopic

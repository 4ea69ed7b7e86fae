// Working space that is kept from one chunk of rows to the next: made once for each thread at work, as memory
// fresh from the system costs more than the work in it.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace scotopic {

/// Objects of T that nobody works with. Any thread.
template <typename T>
class Spares {
 public:
  /// use(T&) with the one that was used last, or a new one, make() -> std::unique_ptr<T>, where all are at
  /// work.
  template <typename Make, typename Use>
  void with(Make make, Use use) {
    std::unique_ptr<T> one = take();
    if (!one) one = make();
    use(*one);
    const std::lock_guard lock(lock_);
    spares_.push_back(std::move(one));
  }

 private:
  std::unique_ptr<T> take() {
    const std::lock_guard lock(lock_);
    if (spares_.empty()) return nullptr;
    std::unique_ptr<T> one = std::move(spares_.back());
    spares_.pop_back();
    return one;
  }

  std::mutex lock_;
  std::vector<std::unique_ptr<T>> spares_;
};

}  // namespace scotopic

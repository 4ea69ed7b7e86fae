// Work that overlaps and is told of in order.
#include "cli/sequence/in_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace scotopic {
namespace {

using namespace std::chrono_literals;

/// Numbers that threads change and wait for. A wait that lasts is a failure, not a hang.
class Shared {
 public:
  template <typename Change>
  void change(const Change& change) {
    const std::lock_guard guard(lock_);
    change();
    changed_.notify_all();
  }
  template <typename Condition>
  bool wait(const Condition& condition) {
    std::unique_lock guard(lock_);
    return changed_.wait_for(guard, 60s, condition);
  }

 private:
  std::mutex lock_;
  std::condition_variable changed_;
};

std::vector<std::size_t> first(std::size_t count) {
  std::vector<std::size_t> out(count);
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

TEST(InOrder, everything_is_done_once_and_told_in_order_though_each_second_one_overtakes) {
  for (const int at_once : {1, 2, 5}) {
    Shared shared;
    std::vector<std::size_t> finished, told;
    std::vector<bool> has(200);
    in_order(
        has.size(), at_once,
        [&](std::size_t i) {
          if (at_once > 1 && i % 2 == 0) {
            EXPECT_TRUE(shared.wait([&] { return has[i + 1]; })) << i;
          }
          shared.change([&] { has[i] = true, finished.push_back(i); });
        },
        [&](std::size_t i) {
          told.push_back(i);
          return true;
        });
    EXPECT_EQ(told, first(has.size()));
    EXPECT_EQ(finished.size(), has.size());
    EXPECT_EQ(std::is_sorted(finished.begin(), finished.end()), at_once == 1);
  }
}

TEST(InOrder, as_many_as_asked_for_are_under_way_and_no_more) {
  Shared shared;
  int now = 0, most = 0;
  in_order(
      40, 3,
      [&](std::size_t i) {
        shared.change([&] { most = std::max(most, ++now); });
        // The first wait for each other: there are three of them.
        if (i < 3) {
          EXPECT_TRUE(shared.wait([&] { return most >= 3; })) << i;
        }
        shared.change([&] { --now; });
      },
      [](std::size_t) { return true; });
  EXPECT_EQ(most, 3);
  EXPECT_EQ(now, 0);
}

TEST(InOrder, after_a_no_nothing_is_begun_and_what_was_begun_is_told) {
  Shared shared;
  std::size_t begun = 0;
  bool released = false;
  std::vector<std::size_t> told;
  in_order(
      1000, 2,
      [&](std::size_t i) {
        shared.change([&] { ++begun; });
        // 6 and 7 are under way when the no is said, until 5, the next, is told.
        if (i >= 6) {
          EXPECT_TRUE(shared.wait([&] { return released; })) << i;
        }
      },
      [&](std::size_t i) {
        told.push_back(i);
        if (i == 5) shared.change([&] { released = true; });
        if (i != 4) return true;
        EXPECT_TRUE(shared.wait([&] { return begun == 8; }));
        return false;
      });
  EXPECT_EQ(told, first(8));
  EXPECT_EQ(begun, 8u);
}

TEST(InOrder, a_caller_that_throws_leaves_no_thread_behind) {
  std::atomic<int> begun = 0, under_way = 0;
  EXPECT_THROW(in_order(
                   100000, 2,
                   [&](std::size_t) {
                     ++begun;
                     ++under_way;
                     std::this_thread::sleep_for(100us);  // all would take seconds
                     --under_way;
                   },
                   [](std::size_t i) -> bool {
                     if (i == 3) throw std::runtime_error("no more");
                     return true;
                   }),
               std::runtime_error);
  EXPECT_EQ(under_way, 0);
  EXPECT_GE(begun, 4);
  EXPECT_LT(begun, 100000);
}

TEST(InOrder, nothing_to_do_is_done_at_once) {
  in_order(
      0, 2, [](std::size_t) { FAIL(); }, [](std::size_t i) { return i > 0; });
}

}  // namespace
}  // namespace scotopic

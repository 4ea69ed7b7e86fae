// Work that overlaps and is told of in order.
#include "cli/sequence/in_order.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace scotopic {
namespace {

using namespace std::chrono_literals;

TEST(InOrder, everything_is_done_once_and_told_in_order) {
  for (const int at_once : {1, 2, 5}) {
    std::vector<std::atomic<int>> worked(200);
    std::vector<std::size_t> told;
    in_order(
        worked.size(), at_once,
        [&](std::size_t i) {
          if (i % 7 == 0) std::this_thread::sleep_for(1ms);  // so that later ones overtake
          ++worked[i];
        },
        [&](std::size_t i) {
          EXPECT_EQ(worked[i], 1);
          told.push_back(i);
          return true;
        });
    ASSERT_EQ(told.size(), worked.size());
    for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], i);
  }
}

TEST(InOrder, as_many_as_asked_for_are_under_way_and_no_more) {
  std::atomic<int> now = 0, most = 0;
  in_order(
      40, 3,
      [&](std::size_t) {
        const int here = ++now;
        int before = most;
        while (before < here && !most.compare_exchange_weak(before, here)) {}
        std::this_thread::sleep_for(3ms);
        --now;
      },
      [](std::size_t) { return true; });
  EXPECT_EQ(most, 3);
}

TEST(InOrder, after_a_no_nothing_is_begun_and_what_was_begun_is_told) {
  std::atomic<std::size_t> begun = 0;
  std::vector<std::size_t> told;
  in_order(
      1000, 2,
      [&](std::size_t) {
        ++begun;
        std::this_thread::sleep_for(1ms);
      },
      [&](std::size_t i) {
        told.push_back(i);
        return i != 4;
      });
  EXPECT_EQ(told.size(), begun);
  EXPECT_GE(told.size(), 5u);
  EXPECT_LT(told.size(), 1000u);
}

TEST(InOrder, a_caller_that_throws_leaves_no_thread_behind) {
  std::atomic<int> begun = 0;
  EXPECT_THROW(in_order(
                   100000, 2, [&](std::size_t) { ++begun; std::this_thread::sleep_for(100us); },
                   [](std::size_t i) -> bool {
                     if (i == 3) throw std::runtime_error("no more");
                     return true;
                   }),
               std::runtime_error);
  const int then = begun;
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(begun, then);
  EXPECT_LT(begun, 100000);
}

TEST(InOrder, nothing_to_do_is_done_at_once) {
  in_order(0, 2, [](std::size_t) { FAIL(); }, [](std::size_t) { return true; });
}

}  // namespace
}  // namespace scotopic

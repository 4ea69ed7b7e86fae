#include "looks/verify/timing.h"

#include <gtest/gtest.h>

#include "looks/verify/evaluator_table.h"

namespace scotopic {
namespace {

TEST(Timing, median_and_quartiles_are_those_of_the_samples) {
  const RunTime t = run_time({5, 1, 4, 2, 3});
  EXPECT_DOUBLE_EQ(t.median, 3);
  EXPECT_DOUBLE_EQ(t.least, 1);
  EXPECT_DOUBLE_EQ(t.quartile_low, 2);
  EXPECT_DOUBLE_EQ(t.quartile_high, 4);
  EXPECT_DOUBLE_EQ(t.spread(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(run_time({1, 2}).median, 1.5);
  EXPECT_DOUBLE_EQ(run_time({7}).spread(), 0);
}

TEST(Timing, runs_take_turns_and_the_first_round_does_not_count) {
  std::string order;
  const std::vector<TimedRun> runs = {{[&] { order += 'p'; }, [&] { order += 'a'; }, 1},
                                      {nullptr, [&] { order += 'b'; }, 1}};
  int reported = 0;
  const auto times = time_interleaved(runs, 2, [&](int, int) { ++reported; });
  EXPECT_EQ(order, "pabpabpab");
  EXPECT_EQ(reported, 3);
  EXPECT_EQ(times.size(), 2u);
}

EvaluatorRow row(const char* group, double time, double mean, double max) {
  EvaluatorRow out;
  out.group = group;
  out.time.median = time;
  out.error.emplace();
  out.error->difference = {mean, max, max};
  return out;
}

TEST(Timing, a_way_is_dominated_by_one_of_its_group_that_is_no_worse_in_anything) {
  std::vector<EvaluatorRow> rows = {row("a", 1, 1, 1), row("a", 2, 1, 1), row("a", 2, 0.5, 2),
                                    row("a", 1, 1, 1), row("b", 9, 9, 9), row("a", 0.5, 2, 0.5),
                                    EvaluatorRow{}};
  rows.back().group = "a";  // fastest of all, but nobody knows its error
  mark_dominated(rows);
  const bool expected[] = {false, true, false, false, false, false, false};
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].dominated, expected[i]) << i;
}

}  // namespace
}  // namespace scotopic

#include "looks/verify/evaluator_table.h"

#include <algorithm>
#include <cstring>

namespace scotopic {
namespace {

bool dominates(const EvaluatorRow& a, const EvaluatorRow& b) {
  if (a.group != b.group || !a.error || !b.error) return false;
  const ErrorStatistics &x = a.error->difference, &y = b.error->difference;
  const bool no_worse = a.time.median <= b.time.median && x.mean <= y.mean && x.max <= y.max;
  return no_worse && (a.time.median < b.time.median || x.mean < y.mean || x.max < y.max);
}

}  // namespace

void mark_dominated(std::vector<EvaluatorRow>& rows) {
  for (EvaluatorRow& row : rows)
    row.dominated = std::any_of(rows.begin(), rows.end(),
                                [&](const EvaluatorRow& other) { return dominates(other, row); });
}

std::vector<EvaluatorRow> time_contenders(const std::vector<Contender>& contenders, std::size_t pixels,
                                          int rounds, const std::function<void(int, int)>& done) {
  const std::vector<float> from(4 * pixels, 1.0f);
  std::vector<float> to(4 * pixels);
  std::vector<TimedRun> runs = {
      {nullptr, [&] { std::memcpy(to.data(), from.data(), to.size() * sizeof(float)); }, pixels}};
  for (const Contender& c : contenders) runs.push_back(c.run);
  const std::vector<RunTime> times = time_interleaved(runs, rounds, done);
  std::vector<EvaluatorRow> rows(1);
  rows[0].group = "memory";
  rows[0].name = "memcpy";
  for (const Contender& c : contenders) rows.push_back(c.row);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time = times[i];
    rows[i].memcpy_ratio = times[i].median / times[0].median;
  }
  mark_dominated(rows);
  return rows;
}

}  // namespace scotopic

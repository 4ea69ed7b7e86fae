// What each evaluator costs and how far off it is: the rows of the table, and which of them nobody needs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "looks/verify/timing.h"
#include "looks/verify/evaluators.h"

namespace scotopic {

/// Evaluators of one group do the same thing, and can be compared.
struct EvaluatorRow {
  std::string group;
  std::string name;
  std::optional<EvaluatorError> error;
  RunTime time;             ///< per pixel
  double memcpy_ratio = 0;  ///< of medians, in one run; memcpy moves RGBA float
  double seconds = 0;       ///< to prepare: baking
  std::size_t bytes = 0;    ///< of tables
  bool dominated = false;   ///< another of its group is no slower and no less accurate, and better in one
};

/// Sets `dominated` by median time and mean and greatest difference. Rows without an error dominate nothing.
void mark_dominated(std::vector<EvaluatorRow>& rows);

/// A row before it is timed.
struct Contender {
  EvaluatorRow row;
  TimedRun run;
  RowOperator apply;  ///< where it computes rows of colours
};

/// Times all in turn, beside a memcpy of `pixels` RGBA float pixels, which is the first row of the result.
std::vector<EvaluatorRow> time_contenders(const std::vector<Contender>& contenders, std::size_t pixels,
                                          int rounds, const std::function<void(int, int)>& done);

}  // namespace scotopic

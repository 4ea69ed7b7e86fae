// The table of `scotopic time` in the forms it is asked for.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "looks/verify/evaluator_table.h"

namespace scotopic {

/// What the numbers hold for.
struct TimeConditions {
  std::string machine;  ///< processor and vector instructions
  std::string ocio;     ///< version
  std::string picture;
  std::string colours;  ///< what errors were measured over
  std::size_t pixels = 0;
  int rounds = 0;
  double load = 0;              ///< the system's, over the last minute
  std::size_t outside_ap1 = 0;  ///< of the colours compared: LUTs clamp them
};

std::string time_text(const std::vector<EvaluatorRow>& rows, const TimeConditions& conditions);
/// One header, one row an evaluator; numbers with a point, whatever the locale.
std::string time_csv(const std::vector<EvaluatorRow>& rows);
nlohmann::ordered_json time_json(const std::vector<EvaluatorRow>& rows, const TimeConditions& conditions);

}  // namespace scotopic

// How far a piece of work is, how fast it goes, and how long it will take.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "report/console.h"

namespace scotopic {

/// On a terminal a bar that is drawn in place, from half a second on; in a log, with `lines`, a line every
/// ten seconds. Silent with --quiet and --json. One thread at a time.
class ProgressLine {
 public:
  enum class Log { lines, silent };

  /// `unit`: what is counted, "frames".
  ProgressLine(const Console& console, std::string unit, std::int64_t total, Log log);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `done` of the total are, `free` of them cost nothing (they were there already) and do not count for the
  /// rate.
  void at(std::int64_t done, std::int64_t free = 0);

  /// "37 of 240 frames, 3.1 frames/s, 1:05 to go"
  std::string text() const;

 private:
  using Clock = std::chrono::steady_clock;
  double seconds() const;
  std::string bar() const;

  const Console& console_;
  std::string unit_;
  std::int64_t total_, done_ = 0, free_ = 0;
  bool bar_shown_, log_shown_;
  Clock::time_point start_ = Clock::now();
  double said_ = 0;  // seconds after the start
};

/// "0:07", "1:12", "2:01:30"
std::string duration_text(double seconds);

}  // namespace scotopic

// Stopwatch for ways of computing the same thing: in turn, so that what else the machine does hits all alike.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace scotopic {

/// Something to time. `prepare`, if any, runs before each run and is not timed.
struct TimedRun {
  std::function<void()> prepare;
  std::function<void()> run;
  std::size_t pixels = 1;
};

/// Wall-clock nanoseconds per pixel over all rounds.
struct RunTime {
  double median = 0;
  double least = 0;
  double quartile_low = 0, quartile_high = 0;

  /// Distance of the quartiles over the median.
  double spread() const { return median > 0 ? (quartile_high - quartile_low) / median : 0; }
};

/// Median, least and quartiles (linear between samples) of at least one number.
RunTime run_time(std::vector<double> nanoseconds);

/// Runs each in turn, `rounds` times, after a round that is not counted. `done(round, of)` after each round.
std::vector<RunTime> time_interleaved(std::span<const TimedRun> runs, int rounds,
                                      const std::function<void(int, int)>& done = nullptr);

}  // namespace scotopic

#include "looks/verify/timing.h"

#include <algorithm>
#include <chrono>

namespace scotopic {
namespace {

double quantile(const std::vector<double>& sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double nanoseconds_per_pixel(const TimedRun& run) {
  using Clock = std::chrono::steady_clock;
  if (run.prepare) run.prepare();
  const Clock::time_point start = Clock::now();
  run.run();
  const std::chrono::duration<double, std::nano> taken = Clock::now() - start;
  return taken.count() / static_cast<double>(run.pixels);
}

}  // namespace

RunTime run_time(std::vector<double> nanoseconds) {
  std::sort(nanoseconds.begin(), nanoseconds.end());
  return {quantile(nanoseconds, 0.5), nanoseconds.front(), quantile(nanoseconds, 0.25),
          quantile(nanoseconds, 0.75)};
}

std::vector<RunTime> time_interleaved(std::span<const TimedRun> runs, int rounds,
                                      const std::function<void(int, int)>& done) {
  std::vector<std::vector<double>> taken(runs.size());
  for (int round = 0; round <= rounds; ++round) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const double ns = nanoseconds_per_pixel(runs[i]);
      if (round > 0) taken[i].push_back(ns);
    }
    if (done) done(round, rounds);
  }
  std::vector<RunTime> out;
  for (auto& samples : taken) out.push_back(run_time(std::move(samples)));
  return out;
}

}  // namespace scotopic

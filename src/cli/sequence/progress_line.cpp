#include "cli/sequence/progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

constexpr double first_bar = 0.5, bar_every = 0.1, line_every = 10;  // seconds

std::string rate_text(double rate, const std::string& unit) {
  return rate >= 0.1 ? fmt::format("{:.3g} {}/s", rate, unit) : fmt::format("{:.3g} s for one", 1 / rate);
}

}  // namespace

std::string duration_text(double seconds) {
  const auto s = static_cast<std::int64_t>(std::min(std::ceil(seconds), 1e9));
  return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                  : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

ProgressLine::ProgressLine(const Console& console, std::string unit, std::int64_t total, Log log)
    : console_(console),
      unit_(std::move(unit)),
      total_(total),
      bar_shown_(on_terminal() && !console.options().quiet && !console.json()),
      log_shown_(!on_terminal() && log == Log::lines && !console.json()) {}

ProgressLine::~ProgressLine() {
  if (bar_shown_) show_status("");
}

double ProgressLine::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

std::string ProgressLine::text() const {
  std::string text = fmt::format("{} of {} {}", done_, total_, unit_);
  const double worked = static_cast<double>(done_ - free_), time = seconds();
  if (worked <= 0 || time <= 0) return text;
  text += ", " + rate_text(worked / time, unit_);
  if (done_ < total_)
    text += ", " + duration_text(static_cast<double>(total_ - done_) * time / worked) + " to go";
  return text;
}

std::string ProgressLine::bar() const {
  const std::string after = " " + text();
  const int columns = terminal_columns() - 1;
  const int room = std::clamp(columns - static_cast<int>(after.size()) - 12, 0, 40);
  const auto full = static_cast<int>(total_ > 0 ? room * done_ / total_ : 0);
  const std::string drawn = room < 4 ? ""
                                     : "[" + std::string(static_cast<std::size_t>(full), '#') +
                                           std::string(static_cast<std::size_t>(room - full), '.') + "]";
  return ("scotopic: " + drawn + after).substr(0, static_cast<std::size_t>(std::max(0, columns)));
}

void ProgressLine::at(std::int64_t done, std::int64_t free) {
  done_ = done;
  free_ = free;
  const double now = seconds();
  if (bar_shown_ && now >= first_bar && (now - said_ >= bar_every || done_ == total_)) {
    said_ = now;
    show_status(bar());
  } else if (log_shown_ && now - said_ >= line_every) {
    said_ = now;
    console_.note(text());
  }
}

}  // namespace scotopic

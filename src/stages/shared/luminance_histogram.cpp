#include "stages/shared/luminance_histogram.h"

#include <algorithm>
#include <limits>

namespace scotopic {

double LuminanceHistogram::first_value(std::size_t bin) noexcept {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bin << bin_shift));
}

double LuminanceHistogram::last_place(std::size_t bin) noexcept {
  // Floats within a bin share an exponent; subnormals that of the smallest normal.
  const int exponent = std::max(1, static_cast<int>(bin >> (23 - bin_shift)));
  return std::ldexp(1.0, exponent - 127 - 23);
}

double LuminanceHistogram::mean(std::size_t bin) const noexcept {
  const Bin& b = bins_[bin];
  return first_value(bin) +
         static_cast<double>(b.above_first) / static_cast<double>(b.count) * last_place(bin);
}

std::uint64_t LuminanceHistogram::count() const noexcept {
  std::uint64_t n = dark_;
  for (const Bin& bin : bins_) n += bin.count;
  return n;
}

double LuminanceHistogram::sum() const noexcept {
  double total = 0;
  for (std::size_t i = 0; i < bins; ++i)
    if (bins_[i].count) total += mean(i) * static_cast<double>(bins_[i].count);
  return total;
}

double LuminanceHistogram::mean_log(double offset) const noexcept {
  double total = static_cast<double>(dark_) * std::log(offset);
  for (std::size_t i = 0; i < bins; ++i)
    if (bins_[i].count) total += std::log(mean(i) + offset) * static_cast<double>(bins_[i].count);
  const std::uint64_t n = count();
  return n ? total / static_cast<double>(n) : std::numeric_limits<double>::quiet_NaN();
}

double LuminanceHistogram::quantile(double q) const noexcept {
  const double wanted = q * static_cast<double>(count());
  double seen = static_cast<double>(dark_);
  double value = 0;
  for (std::size_t i = 0; i < bins && seen < wanted; ++i) {
    if (!bins_[i].count) continue;
    seen += static_cast<double>(bins_[i].count);
    value = mean(i);
  }
  return value;
}

double LuminanceHistogram::share_from(double luminance) const noexcept {
  std::uint64_t above = 0;
  for (std::size_t i = 0; i < bins; ++i)
    if (bins_[i].count && mean(i) >= luminance) above += bins_[i].count;
  const std::uint64_t n = count();
  return n ? static_cast<double>(above) / static_cast<double>(n) : 0;
}

std::vector<std::uint64_t> LuminanceHistogram::octaves(int first_octave, int count) const {
  std::vector<std::uint64_t> out(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < bins; ++i) {
    if (!bins_[i].count) continue;
    const int octave = std::clamp(std::ilogb(first_value(i) + last_place(i)) - first_octave, 0, count - 1);
    out[static_cast<std::size_t>(octave)] += bins_[i].count;
  }
  return out;
}

}  // namespace scotopic

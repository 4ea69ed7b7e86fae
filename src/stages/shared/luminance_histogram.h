// Every luminance of a picture, in one pass, in any order: exact counts and sums that threads can add up.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace scotopic {

/// Bins are runs of 2^18 consecutive floats: 32 to the octave, none wider than 3.1 %. Each keeps its count
/// and the integer sum of its values in units of their last place, so that the result does not depend on the
/// order in which values or histograms are added. Holds up to 2^40 values.
class LuminanceHistogram {
 public:
  static constexpr int bin_shift = 18;
  static constexpr std::size_t bins = 0x7f800000u >> bin_shift;

  LuminanceHistogram() : bins_(bins) {}

  /// 0 and below count as dark, and so does NaN; what is beyond a float counts as the greatest one.
  void add(float luminance) noexcept {
    if (!(luminance > 0)) {
      ++dark_;
      return;
    }
    const std::uint32_t bits =
        std::bit_cast<std::uint32_t>(std::min(luminance, std::numeric_limits<float>::max()));
    Bin& bin = bins_[bits >> bin_shift];
    ++bin.count;
    bin.above_first += bits & ((1u << bin_shift) - 1);
  }

  /// All that another one holds.
  void add(const LuminanceHistogram& other) noexcept {
    dark_ += other.dark_;
    for (std::size_t i = 0; i < bins; ++i) {
      bins_[i].count += other.bins_[i].count;
      bins_[i].above_first += other.bins_[i].above_first;
    }
  }

  /// Values added, dark ones too.
  std::uint64_t count() const noexcept;
  /// Those that were not positive.
  std::uint64_t dark() const noexcept { return dark_; }

  /// Sum of the positive values; exact but for the rounding of one double sum over bins.
  double sum() const noexcept;
  /// Mean of ln(x + offset) over all values, dark ones as x = 0; offset > 0. Each bin counts as its mean,
  /// which is wrong by less than 4e-5 (a picture of one value: exact). No values: NaN.
  double mean_log(double offset) const noexcept;
  /// Smallest bin mean such that the share `q` of all values is at or below it (dark values are 0).
  double quantile(double q) const noexcept;
  /// Share of values at or above `luminance`, to one bin.
  double share_from(double luminance) const noexcept;
  /// Counts per octave, from 2^first_octave on: for display.
  std::vector<std::uint64_t> octaves(int first_octave, int count) const;

 private:
  struct Bin {
    std::uint64_t count = 0;
    std::uint64_t above_first = 0;  // sum of (value - first value of the bin), in units of the last place
  };
  static double first_value(std::size_t bin) noexcept;
  static double last_place(std::size_t bin) noexcept;
  double mean(std::size_t bin) const noexcept;

  std::vector<Bin> bins_;
  std::uint64_t dark_ = 0;
};

}  // namespace scotopic

#include "looks/lut/axes.h"

#include <algorithm>
#include <cmath>

#include "color/primaries.h"

namespace scotopic {
namespace {

constexpr std::size_t table_size = 1 << 14;

double interpolated(const std::vector<double>& table, double index) {
  const auto i = std::min(static_cast<std::size_t>(index), table.size() - 2);
  return table[i] + (index - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

/// Fractional index at which a rising table reaches `value`.
double index_of(const std::vector<double>& table, double value) {
  const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, value);
  const auto i = static_cast<std::size_t>(above - table.begin()) - 1;
  return static_cast<double>(i) + (value - table[i]) / (table[i + 1] - table[i]);
}

template <typename Density>
std::vector<double> cumulative_table(double low, double high, Density density) {
  std::vector<double> table(table_size, 0.0);
  const double step = (high - low) / static_cast<double>(table_size - 1);
  for (std::size_t i = 1; i < table_size; ++i)
    table[i] = table[i - 1] + step * density(low + (static_cast<double>(i) - 0.5) * step);
  const double total = table.back();
  for (double& t : table) t /= total;
  return table;
}

double level_density(double x, std::optional<double> peak) {
  constexpr double dark = -8, dark_root = 5.4, bright = 6, bright_root = 2.5, floor = 0.1;
  // Where saturated blue reaches the photopic 5 cd/m2 and the operator ends in a bend.
  constexpr double bend = 5.2, bend_width = 0.7, bend_height = 1.5;
  const double root = std::exp2((x - dark) / dark_root);
  const double off = (x - bend) / bend_width;
  if (peak) {
    // By trial, for the least 99 % of what is shown at 0.1 to 10 cd/m2.
    constexpr double around = 5, height = 3, over = 9, night_dark = -6, night_root = 3;
    const double from_peak = (x - *peak) / around;
    const double even =
        1 / (std::exp2((night_dark - x) / night_root) + 1 + std::exp2((x - *peak - over) / bright_root));
    return even *
               (1 + bend_height * std::exp(-off * off / 2) + height * std::exp(-from_peak * from_peak / 2)) +
           floor * std::min(1.0, root) * std::exp2(-std::max(0.0, x - *peak - over));
  }
  const double even = 1 / (1 / root + 1 + std::exp2((x - bright) / bright_root));
  return even * (1 + bend_height * std::exp(-off * off / 2)) + floor * std::min(1.0, root);
}

double share_density(double u) {
  constexpr double reach = 0.05;  // how far from its ends an axis is denser
  return 1 + reach / (u + reach) + reach / (1 - u + reach);
}

}  // namespace

LevelAxis::LevelAxis(double highest, std::optional<double> peak)
    : highest_(highest),
      table_(cumulative_table(lowest_, highest, [peak](double x) { return level_density(x, peak); })) {}

double LevelAxis::position(double x) const noexcept {
  if (!(x > lowest_)) return 0;
  if (x >= highest_) return 1;
  return interpolated(table_, (x - lowest_) / (highest_ - lowest_) * static_cast<double>(table_size - 1));
}

double LevelAxis::log2_level(double t) const noexcept {
  const double index = index_of(table_, std::clamp(t, 0.0, 1.0));
  return lowest_ + (highest_ - lowest_) * index / static_cast<double>(table_size - 1);
}

ShareAxis::ShareAxis() : table_(cumulative_table(0, 1, share_density)) {
  // Symmetric to the last digit, so that 1/2 is 1/2.
  for (std::size_t i = 0; i < table_size / 2; ++i) {
    const double half = (table_[i] + 1 - table_[table_size - 1 - i]) / 2;
    table_[i] = half;
    table_[table_size - 1 - i] = 1 - half;
  }
}

double ShareAxis::position(double u) const noexcept {
  return interpolated(table_, std::clamp(u, 0.0, 1.0) * static_cast<double>(table_size - 1));
}

double ShareAxis::share(double t) const noexcept {
  return index_of(table_, std::clamp(t, 0.0, 1.0)) / static_cast<double>(table_size - 1);
}

Matrix3<double> LookCoordinates::from_xyz() {
  const Matrix3<double> ap1 = inverse(gamut_xyz_matrix("ap1").value());
  const Matrix3<double> blue_red_green{{{ap1[2], ap1[0], ap1[1]}}};
  return diagonal<double>({0.5, 0.5, 1}) * blue_red_green;
}

}  // namespace scotopic

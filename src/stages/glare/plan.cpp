#include "stages/glare/plan.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace scotopic::glare {
namespace {

constexpr int rows_of_task = 64;

int tasks_of(int height) { return (height + rows_of_task - 1) / rows_of_task; }

void add_row(const Rows& rows, int planes, int width, Extremes& into) {
  for (int k = 0; k < planes; ++k) {
    const auto [least, greatest] = extremes_of_row(rows.row(k), rows.row(planes), width);
    into.add(static_cast<std::size_t>(k), least, greatest);
  }
}

/// Rows of excess, for one row of the picture.
struct ExcessRows {
  ExcessRows(const Plan& plan, int planes)
      : rows(plan.width(), planes + 1), lit(static_cast<std::size_t>(plan.width() / lit_step + 1)) {
    for (int k = 0; k <= planes; ++k) out[static_cast<std::size_t>(k)] = rows.row(k);
  }
  Rows rows;
  std::vector<std::uint8_t> lit;
  std::array<float*, most_planes> out{};
};

/// Of all rows, or of some of them where `end` says of what a task found that it will do; and whether it did.
template <typename End>
std::pair<Extremes, bool> extremes_until(const Plan& plan, const GlarePicture& picture,
                                         const ParallelFor& parallel_for, End end) {
  const Excess excess = excess_of(plan, picture);
  std::vector<Extremes> parts(static_cast<std::size_t>(tasks_of(plan.height())));
  std::atomic<bool> ended{false};
  for_bands(plan.height(), rows_of_task, parallel_for, [&](int task, int first, int last) {
    ExcessRows own(plan, excess.planes);
    Extremes& part = parts[static_cast<std::size_t>(task)];
    for (int y = first; y < last && !ended; ++y) {
      excess_row(excess, row_of(picture, y), own.out.data(), own.lit.data(), plan.width());
      add_row(own.rows, excess.planes, plan.width(), part);
      if (end(part)) ended = true;
    }
  });
  Extremes all;
  for (const Extremes& part : parts)
    for (std::size_t k = 0; k < most_light; ++k) all.add(k, part.least[k], part.greatest[k]);
  return {all, ended};
}

}  // namespace

Extremes::Extremes() {
  least.fill(std::numeric_limits<float>::infinity());
  greatest.fill(-std::numeric_limits<float>::infinity());
}

void Extremes::add(std::size_t plane, float least_value, float greatest_value) {
  least[plane] = std::min(least[plane], least_value);
  greatest[plane] = std::max(greatest[plane], greatest_value);
}

float Extremes::constant(std::size_t plane) const {
  if (!(least[plane] <= greatest[plane])) return 0;
  return least[plane] >= 0 ? least[plane] : std::min(greatest[plane], 0.0f);
}

bool Extremes::flat() const {
  for (std::size_t k = 0; k < most_light; ++k)
    if (least[k] < greatest[k]) return false;
  return true;
}

bool Extremes::hold_zero(std::size_t planes) const {
  for (std::size_t k = 0; k < planes; ++k)
    if (!(least[k] <= 0 && greatest[k] >= 0)) return false;
  return true;
}

void for_bands(int height, int rows, const ParallelFor& parallel_for,
               const std::function<void(int, int, int)>& task) {
  parallel_for((height + rows - 1) / rows,
               [&](int i) { task(i, i * rows, std::min((i + 1) * rows, height)); });
}

bool any_above(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for) {
  std::atomic<bool> found{false};
  for_bands(plan.height(), rows_of_task, parallel_for, [&](int, int begin, int end) {
    for (int y = begin; y < end && !found; ++y)
      if (!known_below(plan, picture, y) && count_above(row_of(picture, y), plan.threshold, plan.width()) > 0)
        found = true;
  });
  return found;
}

std::ptrdiff_t count_above(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for) {
  std::vector<std::ptrdiff_t> counts(static_cast<std::size_t>(tasks_of(plan.height())));
  for_bands(plan.height(), rows_of_task, parallel_for, [&](int task, int begin, int end) {
    for (int y = begin; y < end; ++y)
      if (!known_below(plan, picture, y))
        counts[static_cast<std::size_t>(task)] +=
            count_above(row_of(picture, y), plan.threshold, plan.width());
  });
  return std::accumulate(counts.begin(), counts.end(), std::ptrdiff_t{0});
}

Extremes extremes(const Plan& plan, const GlarePicture& picture, const ParallelFor& parallel_for) {
  const auto no_end = [](const Extremes&) { return false; };
  return extremes_until(plan, picture, parallel_for, no_end).first;
}

// Zero is in a night's first row: whatever the others hold, the constants are then 0.
std::optional<Constants> constants(const Plan& plan, const GlarePicture& picture,
                                   const ParallelFor& parallel_for) {
  const auto planes = picture.light.size();
  const auto settled = [planes](const Extremes& found) { return found.hold_zero(planes); };
  const auto [found, ended] = extremes_until(plan, picture, parallel_for, settled);
  Constants out{};
  if (ended) return out;
  if (found.flat()) return std::nullopt;
  for (std::size_t k = 0; k < planes; ++k) out[k] = found.constant(k);
  return out;
}

void check_subimage(const Plan& plan, const GlarePicture& picture) {
  if (picture.light.empty() || picture.light.size() > most_light)
    throw std::invalid_argument("glare: 1 to 7 planes of light");
  const auto given = [](const float* plane) { return plane != nullptr; };
  if (!std::all_of(picture.rgb.begin(), picture.rgb.end(), given) ||
      !std::all_of(picture.light.begin(), picture.light.end(), given))
    throw std::invalid_argument("glare: a plane is missing");
  if (picture.stride < plan.width()) throw std::invalid_argument("glare: rows overlap");
}

Excess excess_of(const Plan& plan, const GlarePicture& picture) {
  const bool above = plan.parameters.rule == GlareRule::above;
  return {above ? GlareShare::above : GlareShare::all,
          plan.threshold,
          static_cast<int>(picture.light.size()),
          {}};
}

}  // namespace scotopic::glare

#include "pipeline/rows/non_finite.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>

#include "base/error.h"
#include "scene/scene_statistics.h"

namespace scotopic {
namespace {

bool any_non_finite(const PixelRows& rows) {
  for (const float* plane :
       {static_cast<const float*>(rows.r), static_cast<const float*>(rows.g),
        static_cast<const float*>(rows.b), rows.cone_l, rows.cone_m, rows.cone_s, rows.rod})
    if (plane && scotopic::any_non_finite(plane, rows.count)) return true;
  return false;
}

}  // namespace

void NonFinitePixels::add(const NonFinitePixels& next) {
  const std::uint64_t before = count;
  if (before == 0) *this = next;
  count = before + next.count;
}

std::string describe(const NonFinitePixels& pixels) {
  return fmt::format("{} {} not finite, the first at ({}, {})", pixels.count,
                     pixels.count == 1 ? "pixel is" : "pixels are", pixels.x, pixels.y);
}

void refuse(const NonFinitePixels& pixels, const std::string& file) {
  if (pixels.count > 0) throw Error(ExitCode::input, file, describe(pixels));
}

std::vector<std::size_t> non_finite_of(const PixelRows& rows) {
  std::vector<std::size_t> bad;
  if (any_non_finite(rows))
    for (std::size_t i = 0; i < rows.count; ++i)
      if (!is_finite(rows, i)) bad.push_back(i);
  return bad;
}

void clean(const PixelRows& rows, const std::vector<std::size_t>& pixels) {
  for (const std::size_t i : pixels) {
    const bool black = !finite_signals(rows, i);
    for (float* plane : {rows.r, rows.g, rows.b})
      if (black || !std::isfinite(plane[i])) plane[i] = 0;
  }
}

void NonFiniteTally::add(const std::vector<std::size_t>& pixels, int x, int y) {
  if (!counts_ || pixels.empty()) return;
  const NonFinitePixels here = {pixels.size(), x + static_cast<int>(pixels.front()), y};
  const std::lock_guard guard(lock_);
  const bool first = found_.count == 0 || std::tie(here.y, here.x) < std::tie(found_.y, found_.x);
  if (first) {
    found_.x = here.x;
    found_.y = here.y;
  }
  found_.count += here.count;
}

NonFinitePixels NonFiniteTally::found() const {
  const std::lock_guard guard(lock_);
  return found_;
}

}  // namespace scotopic

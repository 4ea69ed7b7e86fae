#include "scene/scene_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "receptors/receptor_space.h"

namespace scotopic {
namespace {

// What is beyond a float becomes the greatest one: converting it would be undefined.
float to_float(double x) {
  constexpr double greatest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -greatest, greatest));
}

}  // namespace

double SceneStatistics::mean_photopic() const noexcept {
  return finite() ? photopic.sum() / static_cast<double>(finite()) : 0;
}

double SceneStatistics::mean_scotopic() const noexcept {
  return finite() ? scotopic.sum() / static_cast<double>(finite()) : 0;
}

double SceneStatistics::sp_ratio() const noexcept {
  const double light = photopic.sum();
  return light > 0 ? scotopic.sum() / light : sp_ratio_d65;
}

double SceneStatistics::log_mean_luminance() const noexcept {
  // The offset keeps black pixels from pulling the mean to 0.
  const double offset = 1e-6 * static_cast<double>(greatest);
  return offset > 0 ? std::exp(photopic.mean_log(offset)) : 0;
}

bool finite_signals(const PixelRows& rows, std::size_t i) noexcept {
  const auto fine = [i](const float* plane) { return plane == nullptr || std::isfinite(plane[i]); };
  return fine(rows.cone_l) && fine(rows.cone_m) && fine(rows.cone_s) && fine(rows.rod);
}

bool is_finite(const PixelRows& rows, std::size_t i) noexcept {
  return std::isfinite(rows.r[i]) && std::isfinite(rows.g[i]) && std::isfinite(rows.b[i]) &&
         finite_signals(rows, i);
}

void SceneStatistics::add(const SceneStatistics& other) {
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
  photopic.add(other.photopic);
  scotopic.add(other.scotopic);
  non_finite += other.non_finite;
  sp_deviation = std::max(sp_deviation, other.sp_deviation);
  samples.insert(samples.end(), other.samples.begin(), other.samples.end());
}

SceneMeter::SceneMeter(const AppearanceParameters& p, std::uint64_t pixels_in_subimage)
    : xyz_from_rgb_(p.xyz_from_rgb), rods_(p.rods), sp_ratio_(p.sp_ratio) {
  for (std::size_t i = 0; i < 3; ++i) y_row_[i] = static_cast<float>(p.xyz_from_rgb[1][i]);
  const Vec3<double> white = p.xyz_from_rgb * Vec3<double>{1, 1, 1};
  white_scotopic_ = scotopic_luminance_from_xyz<double>(white, rods_, sp_ratio_d65) / white[1];
  // An odd step wanders through the columns whatever the width.
  sample_every_ = std::max<std::uint64_t>(1, pixels_in_subimage / scene_samples) | 1u;
}

void SceneMeter::measure(const PixelRows& rows, std::uint64_t first_pixel, SceneStatistics& s) const {
  const double per_rod = 1 / rod_signal_per_scotopic_luminance();
  for (std::size_t i = 0; i < rows.count; ++i) {
    const Vec3<float> rgb = {rows.r[i], rows.g[i], rows.b[i]};
    const float y = dot(y_row_, rgb);
    // Y is finite only where R, G and B are.
    if (!std::isfinite(y) || !finite_signals(rows, i)) {
      if (!is_finite(rows, i)) ++s.non_finite;
      continue;
    }
    if ((first_pixel + i) % sample_every_ == 0) s.samples.insert(s.samples.end(), rgb.begin(), rgb.end());
    const Vec3<double> wide = {rgb[0], rgb[1], rgb[2]};
    const double scotopic = rows.rod ? per_rod * rows.rod[i]
                                     : scotopic_luminance_from_xyz(xyz_from_rgb_ * wide, rods_, sp_ratio_);
    s.least = std::min(s.least, y);
    s.greatest = std::max(s.greatest, y);
    s.photopic.add(y);
    s.scotopic.add(to_float(scotopic));
    if (y > 0)
      s.sp_deviation = std::max(s.sp_deviation, to_float(std::abs(scotopic / (white_scotopic_ * y) - 1)));
    else if (scotopic > 0)
      s.sp_deviation = std::numeric_limits<float>::infinity();
  }
}

}  // namespace scotopic

#include "bake/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "appearance/batch.h"
#include "appearance/colour_difference.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

/// Additive recurrence on the generalised golden ratio (Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences"): evenly spread, and the same everywhere.
class EvenPoints {
 public:
  Vec3<double> next(double& fourth) {
    // 1.1673...: positive root of x^5 = x + 1.
    constexpr double g = 1.1673039782614187;
    constexpr double step[4] = {1 / g, 1 / (g * g), 1 / (g * g * g), 1 / (g * g * g * g)};
    for (std::size_t i = 0; i < 4; ++i) at_[i] = std::fmod(at_[i] + step[i], 1.0);
    fourth = at_[3];
    return {at_[0], at_[1], at_[2]};
  }

 private:
  double at_[4] = {0.5, 0.5, 0.5, 0.5};
};

}  // namespace

Colours stop_colours(std::size_t count, const Matrix3<double>& xyz_from_gamut,
                     const Matrix3<double>& xyz_from_rgb) {
  const Matrix3<double> rgb_from_gamut = inverse(xyz_from_rgb) * xyz_from_gamut;
  const bool same = xyz_from_gamut.rows == xyz_from_rgb.rows;
  Colours colours;
  EvenPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    double u;
    Vec3<double> c = points.next(u);
    if (i % 4 == 2)
      for (double& x : c) x = x * x * x;
    if (i % 4 == 3) c[i / 4 % 3] = 0;
    const double level = std::exp2(-20 + 28 * u) / std::max({c[0], c[1], c[2], 1e-9});
    Vec3<double> rgb = {level * c[0], level * c[1], level * c[2]};
    if (!same) rgb = rgb_from_gamut * rgb;
    colours.r.push_back(static_cast<float>(rgb[0]));
    colours.g.push_back(static_cast<float>(rgb[1]));
    colours.b.push_back(static_cast<float>(rgb[2]));
  }
  return colours;
}

BakeError compare(const Colours& in, const Colours& expected, const Colours& got,
                  const Matrix3<double>& xyz_from_rgb) {
  const auto at = [](const Colours& c, std::size_t i) { return Vec3<double>{c.r[i], c.g[i], c.b[i]}; };
  std::vector<double> differences(expected.size());
  BakeError error;
  error.samples = expected.size();
  if (differences.empty()) return error;
  double sum = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const double d = exposed_difference(xyz_from_rgb * at(expected, i), xyz_from_rgb * at(got, i));
    differences[i] = d;
    sum += d;
    if (d > differences[error.worst_index]) error.worst_index = i;
  }
  error.mean = sum / static_cast<double>(differences.size());
  error.max = differences[error.worst_index];
  error.worst = at(in, error.worst_index);
  error.expected = at(expected, error.worst_index);
  error.got = at(got, error.worst_index);
  const auto p99 = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
  std::nth_element(differences.begin(), p99, differences.end());
  error.p99 = *p99;
  return error;
}

Colours exact(const AppearanceParameters& parameters, Colours colours) {
  PixelRows rows;
  rows.r = colours.r.data(), rows.g = colours.g.data(), rows.b = colours.b.data(),
  rows.count = colours.size();
  AppearanceBatch(parameters, Precision::dual).apply(rows);
  return colours;
}

void apply(const OCIO::ConstCPUProcessorRcPtr& processor, Colours& c) {
  if (c.size() == 0) return;
  OCIO::PlanarImageDesc image(c.r.data(), c.g.data(), c.b.data(), nullptr, static_cast<long>(c.size()), 1);
  processor->apply(image);
}

BakeError measure_bake(const AppearanceParameters& parameters, const OCIO::ConstCPUProcessorRcPtr& processor,
                       const Matrix3<double>& xyz_from_gamut, std::size_t count) {
  const Colours in = stop_colours(count, xyz_from_gamut, parameters.xyz_from_rgb);
  Colours got = in;
  apply(processor, got);
  return compare(in, exact(parameters, in), got, parameters.xyz_from_rgb);
}

OddPixels odd_pixels(const OCIO::ConstCPUProcessorRcPtr& processor) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const float odd[] = {0.f,      -0.f,  0.18f,  -0.18f, 1e-42f, -1e-42f, 65504.f,
                       -65504.f, 3e38f, -3e38f, inf,    -inf,   nan};
  const float alphas[] = {0.f, 0.5f, 1.f, -1.f, 1e-42f};
  OddPixels result;
  for (const float r : odd)
    for (const float g : odd)
      for (const float b : odd) {
        float pixel[4] = {r, g, b, alphas[result.tested % 5]};
        const float alpha = pixel[3];
        processor->applyRGBA(pixel);
        for (std::size_t c = 0; c < 3; ++c) result.not_finite += std::isfinite(pixel[c]) ? 0 : 1;
        result.alpha_changed += std::memcmp(&alpha, &pixel[3], sizeof alpha) == 0 ? 0 : 1;
        ++result.tested;
      }
  float black[4] = {0, 0, 0, 1};
  processor->applyRGBA(black);
  result.black_stays_black = black[0] == 0 && black[1] == 0 && black[2] == 0;
  return result;
}

std::string error_text(const BakeError& e) {
  return fmt::format("mean {:.2g}, 99 % {:.2g}, max {:.2g}", e.mean, e.p99, e.max);
}

}  // namespace scotopic

#include "looks/verify/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "batch/batch.h"
#include "batch/display_batch.h"
#include "looks/lut/look_chain.h"
#include "stages/shared/colour_difference.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

/// Additive recurrence on the generalised golden ratio (Roberts 2018, "The unreasonable effectiveness of
/// quasirandom sequences"): evenly spread, and the same everywhere.
class EvenPoints {
 public:
  explicit EvenPoints(double start) : at_{start, start, start, start} {}
  Vec3<double> next(double& fourth) {
    // 1.1673...: positive root of x^5 = x + 1.
    constexpr double g = 1.1673039782614187;
    constexpr double step[4] = {1 / g, 1 / (g * g), 1 / (g * g * g), 1 / (g * g * g * g)};
    for (std::size_t i = 0; i < 4; ++i) at_[i] = std::fmod(at_[i] + step[i], 1.0);
    fourth = at_[3];
    return {at_[0], at_[1], at_[2]};
  }

 private:
  double at_[4];
};

/// Negative beyond what float makes of a colour on the border.
bool outside(const Vec3<double>& rgb) {
  constexpr double rounding = 1e-6;
  const auto [low, high] = std::minmax({rgb[0], rgb[1], rgb[2]});
  return low < -rounding * std::abs(high);
}

Vec3<double> at(const Colours& c, std::size_t i) { return {c.r[i], c.g[i], c.b[i]}; }

Matrix3<double> ap1_from(const Matrix3<double>& xyz_from_rgb) {
  return inverse(gamut_xyz_matrix("ap1").value()) * xyz_from_rgb;
}

}  // namespace

std::size_t outside_ap1(const Colours& colours, const Matrix3<double>& xyz_from_rgb) {
  const Matrix3<double> ap1_from_rgb = ap1_from(xyz_from_rgb);
  std::size_t count = 0;
  for (std::size_t i = 0; i < colours.size(); ++i) count += outside(ap1_from_rgb * at(colours, i));
  return count;
}

Colours stop_colours(std::size_t count, const Matrix3<double>& xyz_from_gamut,
                     const Matrix3<double>& xyz_from_rgb, const StopRange& range) {
  const Matrix3<double> rgb_from_gamut = inverse(xyz_from_rgb) * xyz_from_gamut;
  const bool same = xyz_from_gamut.rows == xyz_from_rgb.rows;
  Colours colours;
  EvenPoints points(range.start);
  for (std::size_t i = 0; i < count; ++i) {
    double u;
    Vec3<double> c = points.next(u);
    if (i % 4 == 2)
      for (double& x : c) x = x * x * x;
    if (i % 4 == 3) c[i / 4 % 3] = 0;
    const double level =
        std::exp2(range.low + (range.high - range.low) * u) / std::max({c[0], c[1], c[2], 1e-9});
    Vec3<double> rgb = {level * c[0], level * c[1], level * c[2]};
    if (!same) rgb = rgb_from_gamut * rgb;
    colours.r.push_back(static_cast<float>(rgb[0]));
    colours.g.push_back(static_cast<float>(rgb[1]));
    colours.b.push_back(static_cast<float>(rgb[2]));
  }
  return colours;
}

Comparison::Comparison(const Matrix3<double>& xyz_from_rgb) : Comparison(xyz_from_rgb, exposed_difference) {}

Comparison::Comparison(const Matrix3<double>& xyz_from_rgb, Difference difference)
    : xyz_from_rgb_(xyz_from_rgb), difference_(difference), ap1_from_rgb_(ap1_from(xyz_from_rgb)) {}

void Comparison::add(const Colours& in, const Colours& expected, const Colours& got) {
  for (std::size_t i = 0; i < expected.size(); ++i, ++seen_) {
    const double d = difference_(xyz_from_rgb_ * at(expected, i), xyz_from_rgb_ * at(got, i));
    if (outside(ap1_from_rgb_ * at(in, i))) {
      ++worst_.outside;
      worst_.outside_max = std::max(worst_.outside_max, d);
      continue;
    }
    if (d > worst_.max || differences_.empty()) {
      worst_.max = d;
      worst_.worst = at(in, i);
      worst_.expected = at(expected, i);
      worst_.got = at(got, i);
      worst_.worst_index = seen_;
    }
    differences_.push_back(static_cast<float>(d));
    sum_ += d;
  }
}

BakeError Comparison::result() const {
  BakeError error = worst_;
  error.samples = differences_.size();
  if (error.samples == 0) return error;
  error.mean = sum_ / static_cast<double>(error.samples);
  std::vector<float> sorted = differences_;
  const auto p99 = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 99 / 100);
  std::nth_element(sorted.begin(), p99, sorted.end());
  error.p99 = static_cast<double>(*p99);
  return error;
}

PixelRows rows_of(Colours& colours) {
  PixelRows rows;
  rows.r = colours.r.data();
  rows.g = colours.g.data();
  rows.b = colours.b.data();
  rows.count = colours.size();
  return rows;
}

Colours exact(const AppearanceParameters& parameters, Colours colours) {
  AppearanceBatch(parameters, Precision::dual).apply(rows_of(colours));
  return colours;
}

Colours seen_under(const std::optional<Lamp>& lamp, const AppearanceParameters& parameters, Colours c) {
  if (!lamp) return c;
  const LampOnRgb seen(*lamp, parameters);
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec3<double> rgb = seen({c.r[i], c.g[i], c.b[i]});
    c.r[i] = static_cast<float>(rgb[0]);
    c.g[i] = static_cast<float>(rgb[1]);
    c.b[i] = static_cast<float>(rgb[2]);
  }
  return c;
}

Colours exact_night(const AppearanceParameters& parameters, const NightDisplayParameters& display,
                    Colours colours) {
  colours = exact(parameters, std::move(colours));
  DisplayBatch(of_scene(parameters, display), Precision::dual).apply(rows_of(colours));
  return colours;
}

void apply(const OCIO::ConstCPUProcessorRcPtr& processor, Colours& c) {
  if (c.size() == 0) return;
  OCIO::PlanarImageDesc image(c.r.data(), c.g.data(), c.b.data(), nullptr, static_cast<long>(c.size()), 1);
  processor->apply(image);
}

BakeError measure_bake(const AppearanceParameters& parameters, const OCIO::ConstCPUProcessorRcPtr& processor,
                       const Matrix3<double>& xyz_from_gamut, std::size_t count,
                       const std::optional<Lamp>& lamp) {
  const Colours in = stop_colours(count, xyz_from_gamut, parameters.xyz_from_rgb);
  Colours got = in;
  apply(processor, got);
  Comparison comparison(parameters.xyz_from_rgb);
  comparison.add(in, exact(parameters, seen_under(lamp, parameters, in)), got);
  return comparison.result();
}

BakeError measure_night(const AppearanceParameters& p, const NightDisplayParameters& display,
                        const OCIO::ConstCPUProcessorRcPtr& processor, const Matrix3<double>& xyz_from_gamut,
                        std::size_t count, const std::optional<Lamp>& lamp) {
  const Colours in = stop_colours(count, xyz_from_gamut, p.xyz_from_rgb);
  Colours got = in, expected = exact_night(p, display, seen_under(lamp, p, in));
  apply(processor, got);
  // In units of 100 cd/m2, both.
  for (auto* plane : {&expected.r, &expected.g, &expected.b})
    for (float& x : *plane) x = static_cast<float>(x * display.peak / display_white);
  Comparison comparison(p.xyz_from_rgb, display.peak > display_white ? itp_difference : shown_difference);
  comparison.add(in, expected, got);
  return comparison.result();
}

BakeError measure_look(const LookSpec& spec, const OCIO::ConstCPUProcessorRcPtr& processor) {
  const AppearanceParameters& p = spec.parameters;
  constexpr std::size_t count = 100000;
  if (spec.night) return measure_night(p, *spec.night, processor, p.xyz_from_rgb, count, spec.lamp);
  return measure_bake(p, processor, p.xyz_from_rgb, count, spec.lamp);
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

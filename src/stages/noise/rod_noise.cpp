#include "stages/noise/rod_noise.h"

#include <algorithm>
#include <cmath>

#include "adaptation/pupil.h"
#include "stages/acuity/cutoff.h"
#include "stages/noise/rod_noise-inl.h"
#include "stages/shared/scalar-inl.h"
#include "stages/limits.h"

namespace scotopic {
namespace {

namespace formulas = HWY_NAMESPACE;
using Number = formulas::Scalar<double>;

bool operable(const NoisePixel& p) noexcept {
  const auto inside = [](double x) { return std::abs(x) <= operable_limit; };
  return inside(p.rgb[0]) && inside(p.rgb[1]) && inside(p.rgb[2]) && inside(p.rod) && inside(p.local);
}

}  // namespace

RodPool rod_pool(const RodNoiseParameters& p) noexcept {
  using namespace rod_noise;
  const double trolands = trolands_per_luminance(p.eye.adaptation);
  const double pitch =
      std::max(half_transfer / acuity_cutoff(p.eye.adaptation), least_pitch_pixels / p.pixels_per_degree);
  const double width = pool_width * pitch;
  const double events =
      rods_per_square_degree * isomerisations_per_troland * trolands * width * width * pool_seconds;
  return {pitch, 1 / events,
          dark_events / (isomerisations_per_troland * trolands) + sp_ratio_d65 * p.bleach_light};
}

RodNoiseNeed rod_noise_need(const RodNoiseParameters& p) noexcept {
  const RodPool pool = rod_pool(p);
  const double mean = sp_ratio_d65 * p.eye.adaptation + pool.dark;
  const double hidden = p.hidden_fraction * p.hidden_fraction * mean;
  return {pool.quantum > hidden && p.strength > 0, std::sqrt(pool.quantum / mean)};
}

noise::Field rod_noise_field(const RodNoiseParameters& p, std::uint64_t seed) noexcept {
  return noise::fixed_field({rod_pool(p).pitch, rod_noise::time_pitch, seed});
}

noise::Field rod_noise_octave_field(const RodNoiseParameters& p, std::uint64_t seed) noexcept {
  return noise::octave_field(rod_pool(p).pitch, rod_noise::time_pitch, seed);
}

double noisy_scotopic(const RodNoiseParameters& p, double scotopic, double n) noexcept {
  const RodNoiseConstants<double> k(p);
  const double variance = formulas::rod_variance(Number(), k, scotopic);
  if (!(variance > 0)) return scotopic;
  return scotopic + formulas::rod_fluctuation(Number(), k, scotopic, variance, n);
}

Vec3<double> add_rod_noise(const RodNoiseParameters& p, const NoisePixel& pixel, double n) noexcept {
  if (!operable(pixel)) return pixel.rgb;
  const RodNoiseConstants<double> k(p);
  const formulas::Triple<double> rgb = {pixel.rgb[0], pixel.rgb[1], pixel.rgb[2]};
  const formulas::Triple<double> out = formulas::rod_noise_on(Number(), k, rgb, pixel.rod, pixel.local, n);
  return {out.x, out.y, out.z};
}

}  // namespace scotopic

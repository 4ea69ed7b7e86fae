// Stage `noise`: what few photons do to a dark picture. Rods count single photons, and events of their own
// that they cannot tell from them; near the absolute threshold the eye sees that the counts of neighbours
// differ.
//
//   tpl = trolands per cd/m2 at La        h = max(0.3189/R(La), 0.75/ppd) degrees: a cubic B-spline of this
//   pitch
//                                             has transfer 1/2 at acuity's cut-off R; its effective width is
//                                             (315/151) h
//   Q = 1/(delta k tpl ((315/151) h)^2 tau)   scotopic cd/m2 per event of a pool
//   D = d/(k tpl) + rho (L_r - A_r)           dark light, scotopic cd/m2; a bleach adds to it (Barlow 1964)
//   S = rho Rn unit                           the pixel's scotopic luminance; mu = S + D
//   v = max(0, mu Q - nu^2 (max(S, rho La) + D)^2)      variance, less what the eye's own Weber fraction
//   hides S' = max(0, (sqrt(mu - b) + sqrt(b) n)^2 - D),  b = (v/2)/(mu + sqrt(mu^2 - v/2)),  n of field.h dY
//   = (1 - m) C (S' - S)/(m + (1 - m) rho C)/unit,  m = m(Lloc)      added, or divided out at constant
//   chromaticity
//
// mu Q is de Vries and Rose's law. S' + D is the square of a shifted normal: of mean mu and variance v
// exactly, never negative, and made of square roots alone. Achromatic, after all that pools (acuity) or
// colours.
#pragma once

#include <optional>

#include "stages/noise/field.h"
#include "stages/shared/constants.h"
#include "stages/shared/stage_constants.h"

namespace scotopic {

/// What the stage is told.
struct RodNoiseParameters {
  /// Adaptation luminance, unit, primaries, rods' estimate and light. Its strengths are not read.
  AppearanceParameters eye;
  double pixels_per_degree = 20;  ///< > 0
  std::optional<double>
      rod_adaptation;            ///< L_r, cd/m2, where it is not La (adaptation/time/dark_adaptation.h)
  double bleach_light = 0;       ///< L_r - A_r, cd/m2, >= 0
  double exposure = 1;           ///< e, that the picture was scaled by for adaptation in time
  double strength = 1;           ///< 0 to 1, of dY
  double hidden_fraction = 0.1;  ///< nu: relative fluctuations under it are not seen
};

/// Constants of the eye; from memory unless said.
namespace rod_noise {
inline constexpr double isomerisations_per_troland = 8.6;  ///< k, per rod, second and scotopic troland
inline constexpr double dark_events = 0.01;                ///< d, per rod and second (Barlow's dark light)
inline constexpr double rods_per_square_degree = 12600;    ///< delta
inline constexpr double pool_seconds = 0.1;                ///< tau; 0.1 to 0.2
inline constexpr double pool_width =
    315.0 / 151;  ///< of a cubic B-spline, in pitches: 1 over its square's integral
inline constexpr double half_transfer = 0.3189166986852232;  ///< frequency times pitch where sinc^4 is 1/2
inline constexpr double least_pitch_pixels = 0.75;
inline constexpr double time_pitch = pool_seconds / pool_width;  ///< h_t, seconds
}  // namespace rod_noise

/// The pool and its events at an adaptation luminance; scotopic cd/m2.
struct RodPool {
  double pitch;    ///< h, degrees
  double quantum;  ///< Q: luminance of one event
  double dark;     ///< D: luminance that the rods' own events amount to
};

/// h, Q, D.
RodPool rod_pool(const RodNoiseParameters& parameters) noexcept;

/// Whether a scene calls for noise, and why: `relative` is sd over mean of a pool that sees a light of La,
/// held against hidden_fraction. Where that is not less, v = 0 for every pixel, and no bit changes: from
/// 0.0029756 cd/m2 up by default.
struct RodNoiseNeed {
  bool needed;
  double relative;
};
RodNoiseNeed rod_noise_need(const RodNoiseParameters& parameters) noexcept;

/// The field of a shot that is adapted to one luminance: pitch h, stream 0.
noise::Field rod_noise_field(const RodNoiseParameters& parameters, std::uint64_t seed) noexcept;
/// The same for a shot whose adaptation changes: octave rungs.
noise::Field rod_noise_octave_field(const RodNoiseParameters& parameters, std::uint64_t seed) noexcept;

/// What formulas read, in the number type they work in: nothing but numbers of type T.
template <typename T>
struct RodNoiseConstants {
  WeightConstants<T> weight;
  ReceptorConstants<T> receptors;
  T scotopic_per_rod;  ///< S per rod signal
  T quantum, dark;
  T hidden_square;  ///< nu^2
  T adapted;        ///< rho La
  T rods_weight;    ///< rho C
  T change;         ///< of dY: C e strength/unit

  explicit RodNoiseConstants(const RodNoiseParameters& p) {
    const OperatorConstants c(p.eye);
    const RodPool pool = rod_pool(p);
    const auto t = [](double x) { return static_cast<T>(x); };
    weight = weight_constants<T>(p.eye);
    weight.adaptation = t(p.rod_adaptation.value_or(p.eye.adaptation));
    receptors = receptor_constants<T>(c);
    scotopic_per_rod = t(sp_ratio_d65 * p.eye.white_luminance / c.rod_white);
    quantum = t(pool.quantum);
    dark = t(pool.dark);
    hidden_square = t(p.hidden_fraction * p.hidden_fraction);
    adapted = t(sp_ratio_d65 * p.eye.adaptation);
    rods_weight = t(sp_ratio_d65 * mes2_efficacy_ratio);
    change = t(mes2_efficacy_ratio * p.exposure * p.strength / p.eye.white_luminance);
  }
};

/// S', scotopic cd/m2, from S under the field's n.
double noisy_scotopic(const RodNoiseParameters& parameters, double scotopic, double n) noexcept;

/// A pixel that comes to the stage, and what the eye's receptors had of it as it came in.
struct NoisePixel {
  Vec3<double> rgb{};  ///< as the stages before left it; linear, in units of white_luminance
  double rod = 0;      ///< luminance units per image unit, >= 0
  double local = 0;    ///< Lloc, cd/m2
};

/// The stage in double. What has v = 0, m = 1, or a component that is not finite or beyond 2^120 passes
/// unchanged.
Vec3<double> add_rod_noise(const RodNoiseParameters& parameters, const NoisePixel& pixel, double n) noexcept;

}  // namespace scotopic

// Photopigment under light and in the dark, in closed form: a step of any length is exact where light is
// constant, so that neither the frame rate nor how a shot is cut into pieces changes where it ends.
//
// Rate-limited regeneration (Mahroo & Lamb, Lamb & Pugh): with B the share of pigment that is bleached,
//   dB/dt = I (1 - B)/Q - V B/(B + K)
// In darkness X = (B/K) e^(B/K) decays exactly exponentially with time constant K/V, after any bleach:
// parallel straight lines of log threshold, as they are measured. X is the bleach's equivalent background.
#pragma once

#include <numbers>

namespace scotopic {

/// A pigment's constants. `bleaching` is in the unit of the illuminances it is used with.
struct Pigment {
  double bleaching;     ///< Q, troland seconds
  double half_rate;     ///< K, a share of pigment
  double regeneration;  ///< V, 1/s
};

/// Rhodopsin, by scotopic trolands. Q second-hand (10^6.8 to 10^7); K read (PMC1819465, caption of figure
/// 10); V from the 0.24 decades/min of dark adaptation (Lamb 1981, Lamb & Pugh 2004, second-hand).
inline constexpr Pigment rod_pigment = {1e7, 0.2, 0.2 * 0.24 * std::numbers::ln10 / 60};
/// Cone pigments, by photopic trolands. Q second-hand (1.6e6 to 2.1e6); V from memory: 0.4/min, rate-limited.
inline constexpr Pigment cone_pigment = {2e6, 0.2, 0.008};

/// B after constant illuminance `trolands` (>= 0) for ever; 0 in darkness, below 1.
double bleached_at_equilibrium(const Pigment& pigment, double trolands) noexcept;

/// B in [0, 1] after `seconds` (>= 0) under `trolands` (>= 0). At equilibrium, and for 0 s, `bleached`
/// itself. Relative error of the approach to equilibrium under 1e-13 a step.
double bleached_after(const Pigment& pigment, double bleached, double trolands, double seconds) noexcept;

/// X = (B/K) e^(B/K).
double equivalent_background(const Pigment& pigment, double bleached) noexcept;

}  // namespace scotopic

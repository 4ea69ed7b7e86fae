// CIE 191:2010, "Recommended System for Mesopic Photometry Based on Visual Performance" (MES2).
#pragma once

#include "receptors/rods.h"

namespace scotopic {

/// Ratio of the maximum luminous efficacies, photopic over scotopic (683 and 1699 lm/W), as MES2 writes it.
inline constexpr double mes2_efficacy_ratio = 683.0 / 1699.0;
/// m = mes2_offset + mes2_slope log10 Lmes.
inline constexpr double mes2_offset = 0.767;
inline constexpr double mes2_slope = 0.3334;

/// What MES2 makes of a photopic and a scotopic luminance.
struct MesopicState {
  double adaptation_coefficient;  ///< m: 1 photopic (cones alone), 0 scotopic (rods alone)
  double luminance;               ///< Lmes, cd/m2
};

/// MES2 by its own iteration from m = .5, the clamp inside, until it stands still. Luminances in cd/m2, >= 0.
/// Both 0 gives m = 0, never NaN. m to 1e-15 for S/P .25 to 4.
MesopicState mesopic_state(double photopic, double scotopic) noexcept;

/// Luminance from which MES2 has m = 1: 10^((1 - .767)/.3334) = 4.998 cd/m2, whatever the S/P ratio.
double mesopic_photopic_limit() noexcept;

/// Photopic luminance up to which m = 0 for a light of this S/P ratio (.0020 cd/m2 for D65).
double mesopic_scotopic_limit(double sp_ratio = sp_ratio_d65) noexcept;

/// m of a light of luminance `photopic` and the given S/P ratio: the same fixed point, by Newton's method on
/// its explicit inverse, to 2 ulp of 1. Non-decreasing in `photopic`; exactly 0 and 1 outside the two limits.
/// (For S/P under .1, less than any lamp's, MES2 has two fixed points at once; this is the lower one.)
double mesopic_coefficient(double photopic, double sp_ratio = sp_ratio_d65) noexcept;

/// Lmes, cd/m2, of a light under the adaptation coefficient `m`: (m Lp + (1-m) Ls C)/(m + (1-m) C).
double mesopic_luminance(double photopic, double scotopic, double m) noexcept;

}  // namespace scotopic

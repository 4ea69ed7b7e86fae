// The least difference of luminance that an eye adapted to a luminance sees, and the exposure that keeps what
// is just visible in a scene just visible on a display (Ward 1994, "A contrast-based scalefactor for
// luminance display").
#pragma once

namespace scotopic {

/// Threshold against adaptation luminance: whose measurements the exposure rests on.
enum class VisibilityRule {
  ward1997,  ///< Ferwerda et al. 1996 as Ward Larson, Rushmeier & Piatko 1997 write them down
  hdrvdp2,   ///< the joint rod and cone sensitivity of HDR-VDP-2 (Mantiuk et al. 2011)
};

/// What eyes at a display whose white is 100 cd/m2 are adapted to, cd/m2 (our choice: its middle grey).
inline constexpr double viewing_adaptation = 18;

/// t(L), cd/m2, for L > 0 in cd/m2: piecewise in log10 L. The limits between the pieces are where these meet
/// to 4e-4 decades, not the printed ones (-3.94, -1.44, 1.9), so that no shot jumps as its adaptation passes
/// them.
double visible_difference(double luminance) noexcept;

/// S(L) of HDR-VDP-2 without its factor: ((4.0627/L)^1.6596 + 1)^-0.2712; what contrast is visible goes as
/// 1/S.
double joint_sensitivity(double luminance) noexcept;

/// EV_d, the stops by which a scene seen at adaptation luminance La (cd/m2, > 0) is shown darker than one
/// whose middle grey is the viewer's adaptation: min(0, log2((La/La_d) t(La_d)/t(La))), or log2
/// S(La)/S(La_d); never above 0.
double visibility_stops(double adaptation, VisibilityRule rule, double viewing = viewing_adaptation) noexcept;

}  // namespace scotopic

// The appearance operator as a chain of CLF operations: what a look is made of.
#pragma once

#include <optional>

#include "stages/display/night_display.h"
#include "stages/lamp/lamp.h"
#include "stages/shared/parameters.h"
#include "looks/chain/chain.h"

namespace scotopic {

/// Largest component a look takes: half's largest. Beyond, and for infinities, it is taken for this.
inline constexpr double look_limit = 65504;

/// The chain for linear RGB in and out (that of parameters.xyz_from_rgb, in units of white_luminance):
///
///   clamp to +-65504 (a NaN is clamped to -65504, hence black or nearly)
///   -> RGB of AP1, cd/m2 -> clamp at 0 -> sums -> log2 -> differences: two shares, a level
///   -> 1D: nodes where the operator bends -> 3D, `edge` nodes a side, tetrahedral -> 1D back
///   -> sums of logarithms -> antilog2 -> differences -> RGB.
///
/// The 3D part is in cd/m2 and knows nothing of white_luminance, which sits in the matrices alone: as a
/// function of the adaptation luminance there is one for each. Black is black, exactly; so is every colour
/// that AP1 does not hold clamped to its border, continuously. `edge` is 2^k + 1, 17 to 129. What the eye's
/// being used to `lamp` makes of light is in the 3D part, too: it is no matrix where colours fade, and one
/// before the clamp would clip those to AP1 instead (CIEDE2000 40).
Chain look_chain(const AppearanceParameters& parameters, std::size_t edge,
                 const std::optional<Lamp>& lamp = std::nullopt);

/// The same with the display stage behind it: what comes out is linear light of the display in the RGB that
/// goes in, 1 = display_white. Its nodes lie around the display's peak. `display` gives peak, primaries and
/// visibility; adaptation, unit and primaries of the RGB are those of `parameters`.
Chain night_chain(const AppearanceParameters& parameters, const NightDisplayParameters& display,
                  std::size_t edge, const std::optional<Lamp>& lamp = std::nullopt);

/// `display` for the scene of `parameters`.
NightDisplayParameters of_scene(const AppearanceParameters& parameters,
                                NightDisplayParameters display) noexcept;

/// cd/m2 that 1 of a display's light stands for, as OpenColorIO's displays have it.
inline constexpr double display_white = 100;

}  // namespace scotopic

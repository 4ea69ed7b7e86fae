// Which way to compute: the cheapest that is accurate enough, or the most accurate that is cheap enough.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "stages/shared/parameters.h"
#include "looks/verify/ways.h"

namespace scotopic {

/// What is asked for; at least one of the two.
struct WayDemand {
  std::optional<double> max_error;  ///< CIEDE2000 exposed to Y = .184, of the worst colour
  std::optional<double> budget;     ///< nanoseconds per pixel on one thread
};

/// A way, its worst error (CIEDE2000) and its cost per pixel.
struct MeasuredWay {
  std::string_view name;
  double max_error = 0;
  double nanoseconds = 0;
};

/// The place of the way to take: among those that meet the demand the cheapest, or, where there is only a
/// budget, the most accurate. nullopt: none does.
std::optional<std::size_t> pick_way(std::span<const MeasuredWay> measured, const WayDemand& demand);

/// What was measured, and what came of it.
struct WayChoice {
  std::vector<MeasuredWay> measured;
  std::optional<std::size_t> picked;
  PreparedWay way;  ///< of the one picked
};

/// Measures ways here and now, over colours of all brightness of the working gamut, and picks. LUTs, from the
/// smallest, are looked at only while they are cheaper than computing in float, which is closer than any LUT.
/// `luts`: whether LUTs will do at all.
WayChoice choose_way(const AppearanceParameters& parameters, const WayDemand& demand, bool luts);

}  // namespace scotopic

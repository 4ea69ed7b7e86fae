// What is said of pixels that are no light.
#pragma once

#include <cstdint>
#include <string>

#include "cli/console.h"
#include "pipeline/non_finite.h"

namespace scotopic {

/// Says once how many pixels are not finite, where the first is, and what was `done` with them; returns their number.
/// `met`: of those that were met on the way, which costs nothing; only if there are any is the file read again.
std::uint64_t report_non_finite(std::uint64_t met, const std::string& done, PixelSource& source, const ImageLayout& layout,
                                const ColourConfig& config, const Console& console);

}  // namespace scotopic

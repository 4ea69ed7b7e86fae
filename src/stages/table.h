// The way of a pixel through the operator, as a timetable: what each stage takes, gives, and is switched by.
#pragma once

#include <array>
#include <string_view>

namespace scotopic {

/// A line of the timetable.
struct Stage {
  std::string_view name;
  std::string_view in;
  std::string_view out;
  std::string_view effect;       ///< the word of --effects that switches it; empty: always on
  std::string_view passes_when;  ///< the pixel goes through unchanged, bit for bit, when
};

inline constexpr std::array<Stage, 6> stages = {{
    {"receptors", "RGB, XYZ or spectrum", "q = (L, M, S), r", "", "a component is not finite, or beyond 2^120"},
    {"weight", "Y, La", "Lloc = La + max(0, Y), w = strength (1 - m(Lloc))", "", "Lloc >= 5 cd/m2"},
    {"shift", "q, r, w", "RGB + RGB_from_LMS w Δq", "shift", "w = 0"},
    {"projection", "RGB", "the nearest colour, in LMS, inside the gamut", "shift", "inside the gamut"},
    {"luminance", "RGB, Y, r, m", "RGB scaled to the policy's luminance", "luminance", "m = 1, or policy none"},
    {"chroma", "RGB, Lloc", "Y + s(Lloc)/s(5) (RGB - Y)", "chroma", "Lloc >= 5 cd/m2"},
}};

/// From here on cones see alone (cd/m2): MES2 has m = 1 and the chroma factor is 1, so nothing is computed.
inline constexpr double photopic_luminance = 5.0;

/// A pixel with a component of larger magnitude (or none: NaN) passes unchanged: float sums would overflow.
inline constexpr double operable_limit = 0x1p120;

}  // namespace scotopic

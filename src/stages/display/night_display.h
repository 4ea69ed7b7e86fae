// Stage `display`: from scene light as it is seen to what a display is sent. One scale for all of a picture,
// after Ward 1994
// ("A contrast-based scalefactor for luminance display"): what is just visible in the scene is just visible
// on the display. No neighbours and no measuring: constant over a shot, and exact in a LUT. What is brighter
// than the display goes over a shoulder, hue kept, and turns white from there on: a lamp has a white core, as
// cameras, films and eyes have it.
//   k  = (La_d/La) 2^EV_d(La)                 display cd/m2 per scene cd/m2 (adaptation/thresholds.h)
//   x  = max(0, rgb) k unit/peak              in the display's primaries; v = max(x)
//   s  = v (v <= a), a + (1-a)(1 - e^(-(v-a)/(1-a))) (v > a), a = 1/2
//   w  = max(0, v-1)/(max(0, v-1) + whiteness)
//   out = x s/v (1-w) + s w                   in [0, 1): 1 is the display's peak
#pragma once

#include <cmath>

#include "adaptation/closed_forms.h"
#include "adaptation/thresholds.h"
#include "stages/shared/parameters.h"

namespace scotopic {

/// Share of the peak up to which light is shown as it is (our choice).
inline constexpr double shoulder_start = 0.5;
/// Light over the peak, in peaks, at which a colour is half way to white (our choice, by eye: a red tail lamp
/// of 60, 2, 0.5 stays red at La 0.1 and 0.01 - with 8 it is pink -, and a street lamp of some hundred peaks
/// has a white core).
inline constexpr double shoulder_whiteness = 32;

/// Whether light that the display cannot show is bent below its peak. `clip` is for pictures that cannot hold
/// such light.
enum class Shoulder { bend, clip };

/// What the stage is told.
struct NightDisplayParameters {
  double adaptation = 0.1;              ///< La, cd/m2; > 0
  double white_luminance = 0.1 / 0.18;  ///< cd/m2 of image value 1; > 0
  double viewing = viewing_adaptation;  ///< La_d, cd/m2; > 0
  double peak = 100;                    ///< of the display, cd/m2; > 0
  VisibilityRule rule = VisibilityRule::hdrvdp2;
  double strength = 1;  ///< 0 to 1, of EV_d
  Shoulder shoulder = Shoulder::bend;
  Matrix3<double> xyz_from_rgb = identity3<double>();      ///< of the planes
  Matrix3<double> xyz_from_display = identity3<double>();  ///< of the display's primaries
};

/// The numbers that k unit/peak is made of; V: see adaptation/closed_forms.h.
template <class V>
struct DisplayLight {
  V adaptation, white_luminance, viewing, peak, strength;
};
/// k unit/peak.
template <class V>
V display_scale(const DisplayLight<V>& light, VisibilityRule rule) {
  using std::exp2;
  const V stops = light.strength * closed_forms::visibility_stops(light.adaptation, rule, light.viewing);
  return light.viewing / light.adaptation * exp2(stops) * light.white_luminance / light.peak;
}

/// k unit/peak: display light, in peaks, per image value. Exactly 1 where it is 1 to rounding, so that such
/// pictures keep their bits.
double display_scale(const NightDisplayParameters& parameters) noexcept;

/// The stage in double: linear RGB of the planes' primaries, 1 = the display's peak. A pixel with a component
/// that is not finite, or beyond 2^120, passes unchanged.
Vec3<double> night_display(const NightDisplayParameters& parameters, const Vec3<double>& rgb) noexcept;

/// What formulas read; see pixel_stages.
template <typename T>
struct DisplayConstants {
  Matrix3<T> display_from_rgb;  ///< with the scale
  Matrix3<T> rgb_from_display;
  T scale, start, room, inverse_room, whiteness;

  explicit DisplayConstants(const NightDisplayParameters& p) {
    const double factor = display_scale(p);
    const Matrix3<double> to_display = inverse(p.xyz_from_display) * p.xyz_from_rgb;
    const auto t = [](double x) { return static_cast<T>(x); };
    display_from_rgb = (factor * to_display).template to<T>();
    rgb_from_display = inverse(to_display).template to<T>();
    scale = t(factor);
    start = t(shoulder_start);
    room = t(1 - shoulder_start);
    inverse_room = t(1 / (1 - shoulder_start));
    whiteness = t(shoulder_whiteness);
  }
};

/// What of the formula is on.
struct DisplaySwitches {
  bool bend, same_primaries;

  explicit DisplaySwitches(const NightDisplayParameters& p) noexcept
      : bend(p.shoulder == Shoulder::bend), same_primaries(p.xyz_from_rgb.rows == p.xyz_from_display.rows) {}
};

}  // namespace scotopic

// What a cube is to hold: the operator between codes of a colour space, or from them to a display's.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "color/colour_config.h"
#include "looks/lut/look_spec.h"
#include "looks/verify/measure.h"

namespace scotopic {

/// Codes in, codes out, and how different two codes out look.
class CubeGoal {
 public:
  /// `spec`: an encoded one. With spec.night, what comes out are codes of spec.display, a space of `config`.
  CubeGoal(const LookSpec& spec, const ColourConfig& config);

  /// Linear working RGB of codes that go in.
  Colours light(Colours codes) const;
  /// Codes in of linear working RGB.
  Colours codes(Colours light) const;
  /// Codes out, exact, rounded to float; those beyond 0 to 1 too.
  Colours exact(const Colours& codes) const;
  /// Linear working RGB of codes out, 1 for white (of a display: for its 100 cd/m2).
  Colours light_out(Colours codes) const;
  /// CIE XYZ (D65) of the same.
  std::vector<Vec3<double>> seen(Colours codes) const;
  /// Of two such: CIEDE2000 of pixels exposed alike; of what a display of 100 cd/m2 shows as it is; ITP above
  /// that peak.
  Comparison::Difference difference() const noexcept { return difference_; }

 private:
  AppearanceParameters parameters_;
  std::optional<Lamp> lamp_;
  std::optional<NightDisplayParameters> night_;
  RowConverter to_light_, from_light_, to_codes_, from_codes_;
  Comparison::Difference difference_;
};

}  // namespace scotopic

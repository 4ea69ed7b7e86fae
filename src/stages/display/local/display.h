// From what the eye sees to what a display can show: the last stage, after the operator. The display step of
// Kirk & O'Brien 2011: projection onto the display's gamut, the tone map of Durand & Dorsey 2002, and their
// range reduction.
#pragma once

#include <memory>
#include <optional>

#include "stages/acuity/filter.h"
#include "stages/shared/parameters.h"
#include "stages/shared/luminance_histogram.h"

namespace scotopic {

/// cd/m2 that value 1 of display light stands for, as OpenColorIO's displays have it.
inline constexpr double display_unit = 100.0;

/// What the base layer of a picture spans, cd/m2 of the scene; 0 < low <= high.
struct DisplayRange {
  double low = 0;
  double high = 0;
};

/// What the last stage is told: the scene, and the display.
struct DisplayParameters {
  double adaptation = 0.1;              ///< La, cd/m2; > 0
  double white_luminance = 0.1 / 0.18;  ///< cd/m2 of image value 1; > 0
  Weight weight = Weight::local;
  double strength = 1.0;  ///< of the range reduction, 0 to 1; with its w as the operator has it

  /// Span of the base layer on a display of 100 cd/m2 (Durand & Dorsey: 5); a brighter one has that much
  /// more. >= 1.
  double contrast = 5.0;
  /// Greatest luminance of the display, cd/m2; > 0.
  double peak = display_unit;
  /// gamma and beta of the range reduction: x = max(1 - w^beta (1 - gamma), gamma) v. Kirk & O'Brien: .25 to
  /// .5, and 1.
  double night_range = 0.35;
  double night_exponent = 1.0;
  double exposure = 0;  ///< EV, of display light, before what is too bright is taken back

  /// Durand & Dorsey: .02 of the picture's longer side, in pixels; and .4 decades of luminance.
  double sigma = 0;
  double range_sigma = 0.4;

  /// CIE XYZ (D65) from the RGB of the planes, and from that of the display's gamut; invertible.
  Matrix3<double> xyz_from_rgb = identity3<double>();
  Matrix3<double> xyz_from_gamut = identity3<double>();
};

/// The base layer: the bilateral mean of log luminance, so that edges between lit and unlit stay. A pixel
/// comes out with its base luminance, in image units, in each of r, g and b; with 0 where it is black or not
/// finite, of which there is no base. Luminance under 1e-6 La counts as that, over 1e14 La as that.
class BaseLayer : public SpatialFilter {
 public:
  /// Throws std::invalid_argument where a parameter is outside its stated domain.
  explicit BaseLayer(const DisplayParameters& parameters);
  ~BaseLayer() override;

  int halo() const noexcept override;
  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for = serial_for) const override;

 private:
  friend class DisplayFilter;
  struct Plan;
  std::unique_ptr<const Plan> plan_;
};

/// Display light from seen light: value 1 is 100 cd/m2, no component below 0 or above the peak.
///  1. The nearest colour, in LMS, that the display's gamut holds (Kirk & O'Brien, equations 14-15).
///  2. base' = log peak + c (base - log high), c = min(1, log contrast/log(high/low)); detail stays (Durand &
///  Dorsey).
///  3. Above .8 of the peak a shoulder, continuous with its slope, that ends at the peak (ours: no lamp
///  clips).
///  4. x = max(1 - w^beta (1 - gamma), gamma) v with w = strength (1 - m(Lloc)): night does not fill the
///  display.
///  5. A colour brighter in one component than the peak loses saturation until it fits, at constant luminance
///  (ours).
/// Continuous (C0); a grey stays grey; luminance rises with the scene's luminance where the base does. A
/// pixel that is not finite passes unchanged and is seen by no other; black stays black.
class DisplayFilter : public SpatialFilter {
 public:
  /// `range`: measured, or given.
  DisplayFilter(const DisplayParameters& parameters, const DisplayRange& range);
  ~DisplayFilter() override;

  int halo() const noexcept override;
  void filter(const AcuityWindow& window, const AcuityTile& tile,
              const ParallelFor& parallel_for = serial_for) const override;

  /// c of step 2.
  double compression() const noexcept;

 private:
  struct Plan;
  BaseLayer base_;
  std::unique_ptr<const Plan> plan_;
};

/// Shares of a picture's pixels whose base layer lies below the range, and not above it: a few pixels of
/// noise or of lamps do not decide how flat the rest is shown. (Durand & Dorsey take the extremes.)
inline constexpr double range_below = 0.01;
inline constexpr double range_up_to = 0.999;

/// The range of a base layer whose values (image units, 0 left out) the histogram holds; of none, La alone.
DisplayRange range_of(const LuminanceHistogram& base, const DisplayParameters& parameters) noexcept;

/// sigma for a picture of this size: .02 of its longer side.
double display_sigma(int width, int height) noexcept;

/// The range reduction's factor: 1 where w = 0, gamma where w = 1, never less than gamma.
double night_factor(double w, double night_range, double night_exponent) noexcept;

}  // namespace scotopic

// How much contrast the eye needs at a spatial frequency and a luminance, and what is left of more than that.
#pragma once

#include <vector>

namespace scotopic::contrast {

/// Modulation transfer of the eye's optics at `frequency` cycles per degree (>= 0): the sum of exponentials
/// of HDR-VDP-2 (Mantiuk, Kim, Rempel and Heidrich 2011, supplement). 1 at 0, falling.
double optical_transfer(double frequency) noexcept;

/// Contrast sensitivity CSF(rho, L) of HDR-VDP-2 with its optics and joint rod and cone sensitivity:
/// frequency in cycles per degree, > 0; luminance in cd/m2, > 0. Its shape is tabulated at 0.002 ... 150
/// cd/m2, linear in log10 L and held beyond.
double contrast_sensitivity(double frequency, double luminance) noexcept;

/// Threshold G_t as contrast in log10 units, 1/2 log10((1+t)/(1-t)) of the Michelson contrast
/// t = 1/max(8.6 CSF, 1.0202): 8.6 is the absolute sensitivity that Wanat and Mantiuk 2014 measured, and no
/// threshold is above t = 0.980 (G_t = 1.00), so that it stays finite.
double threshold_contrast(double frequency, double luminance) noexcept;

/// Kulikowski's rule (1976), two contrasts look alike at equal distances from their thresholds: the share of
/// `contrast` (log10 units) that is left where the threshold of what is looked at exceeds that of the display
/// by `excess`. min(1, max(contrast - excess, 0.001)/contrast); 1 where excess <= 0.
double kept_share(double contrast, double excess) noexcept;

/// Decades to octaves.
inline constexpr double log2_of_10 = 3.321928094887362;

/// Contrast below which nothing is taken away, log10 units: a 430th, less than one eighth of the least
/// threshold there is.
inline constexpr double least_contrast = 0.001;

/// Middle frequencies of the bands of a picture, cycles per degree, finest first: ppd/4, ppd/8, ... while at
/// least 2. Empty below 8 pixels per degree. At most 24.
std::vector<double> band_frequencies(double pixels_per_degree);

/// What shows the picture: `scale` cd/m2 of display for each cd/m2 of scene (> 0), up to `peak` cd/m2 (> 0).
struct DisplayLight {
  double scale = 1.0;
  double peak = 100.0;
};

/// What a band's threshold in the scene exceeds the display's by, log10 units, >= 0, where the scene around
/// has `luminance` cd/m2 (>= 0) and the eye is adapted to `adaptation` (> 0): scene side at
/// adaptation + luminance, display side at min(scale luminance, peak).
double threshold_excess(double frequency, double adaptation, double luminance, const DisplayLight& display);

/// Whether a scene calls for the stage, and the number that says so.
struct ContrastNeed {
  bool needed = false;
  double excess = 0.0;     ///< greatest that any pixel of any band can have, log10 units
  double frequency = 0.0;  ///< cycles per degree of that band; 0: there is no band
  const char* reason = "";
};

/// An excess under this is not called for: 1.2 % of contrast.
inline constexpr double negligible_excess = 0.005;

/// Not needed where in every band G_t(rho, La) - G_t(rho, L) < negligible_excess for the display luminance
/// L <= peak that serves the band best.
ContrastNeed contrast_need(double adaptation, double pixels_per_degree, double peak);

}  // namespace scotopic::contrast

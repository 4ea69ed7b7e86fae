// From spectral bands to receptor signals: what each band of an image weighs.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "receptors/spectrum.h"

namespace scotopic {

/// What is made of a spectrum: cones and rods in luminance units, CIE 1931 XYZ in cd/m2.
enum class Signal : std::size_t { l, m, s, rod, x, y, z };
inline constexpr std::size_t signal_count = 7;
inline constexpr std::array<Signal, signal_count> all_signals = {Signal::l, Signal::m, Signal::s, Signal::rod,
                                                                 Signal::x, Signal::y, Signal::z};
/// Place of a signal in arrays.
constexpr std::size_t index(Signal signal) { return static_cast<std::size_t>(signal); }

/// The curve that a signal weighs light with, and the factor that makes its integral over W/(m2 sr) the
/// signal.
const TabulatedCurve& sensitivity(Signal signal);
/// That factor: luminance units, or cd/m2, per W/(m2 sr).
double signal_per_watt(Signal signal);

/// bin: a band's value is the mean over its bin. point: it is the value at the band's centre.
enum class BandSampling { bin, point };

/// Spectral radiance (W/(m2 sr nm)), or the radiance of the whole band (W/(m2 sr)).
enum class BandUnit { per_nm, per_band };

/// Bands with their bins: edges halfway between neighbouring centres, the outermost bins symmetric.
class BandGrid {
 public:
  /// Centres in nm, ascending, positive and finite; at least two (one band alone has no width).
  explicit BandGrid(std::vector<double> centres_nm);

  /// Number of bands.
  std::size_t size() const { return centres_.size(); }
  /// nm.
  double centre(std::size_t band) const { return centres_[band]; }
  /// nm.
  double lower_edge(std::size_t band) const { return edges_[band]; }
  /// nm.
  double upper_edge(std::size_t band) const { return edges_[band + 1]; }
  /// nm.
  double width(std::size_t band) const { return edges_[band + 1] - edges_[band]; }

 private:
  std::vector<double> centres_;
  std::vector<double> edges_;
};

/// What each band gives to each signal.
struct SpectralWeights {
  /// [signal][band]: a signal is the sum over the bands of weight times value.
  std::array<std::vector<double>, signal_count> of;
  /// Share of a signal of equal-energy light (reflective: of the illuminant) that lies outside the bands.
  std::array<double, signal_count> outside{};
};

/// Weights for spectral radiance. Bins: the sensitivity, piecewise linear between its samples, integrated
/// exactly over each bin; relative error of a weight 1e-14. Points: the sensitivity at the centre times the
/// bin's width.
SpectralWeights emissive_weights(const BandGrid& grid, BandSampling sampling, BandUnit unit);

/// Weights for reflectance under an illuminant (any scale, must not be all dark), such that a perfect white
/// has a luminance of 1: signals are per cd/m2 of the white.
SpectralWeights reflective_weights(const BandGrid& grid, BandSampling sampling,
                                   const TabulatedCurve& illuminant);

}  // namespace scotopic

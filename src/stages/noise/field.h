// The random field of rod noise: n(x, y, t) over angle and time, of variance exactly 1 at every point and
// spectrum that of white photon noise through the eye's pool. It depends on direction, time and seed alone:
// not on resolution, tiles, frame rate, or the order in which frames are made.
//
// Random numbers z of a lattice (pitch h degrees, h degrees, h_t seconds), one Philox each, are weighed by
// cubic B-splines:
//   n = sum over 4 x 4 x 4 of b_i b_j b_k z / sqrt(sum b_i^2 sum b_j^2 sum b_k^2)
// No function but the square root: the same double everywhere. Excess kurtosis -0.09; |n| <= 4.9.
#pragma once

#include <array>
#include <cstdint>

namespace scotopic::noise {

/// One lattice.
struct Lattice {
  double pitch;       ///< h, degrees; > 0
  double time_pitch;  ///< h_t, seconds; > 0
  std::uint64_t seed = 0;
  std::uint32_t stream = 0;  ///< tells apart lattices of one seed
};

/// z: mean 0, variance 1, by four uniform numbers; a place's own, whoever asks.
double lattice_value(const Lattice& lattice, std::int64_t x, std::int64_t y, std::int64_t time) noexcept;

/// Where a coordinate (in pitches) lies: the first of the four lattice points around it, and their weights,
/// whose squares add up to 1.
struct Taps {
  std::int64_t first;
  std::array<double, 4> weight;
};

/// Cubic B-spline, for |coordinate| < 2^52.
Taps spline_taps(double coordinate) noexcept;

/// n at x, y degrees and t seconds, by its 64 terms: what every faster way is held to.
double field_at(const Lattice& lattice, double x, double y, double t) noexcept;

/// A field whose pitch changes within a shot, as the eye adapts, without zooming: two lattices of fixed
/// pitches 2^k/64 and 2^(k+1)/64 degrees, mixed so that the variance stays 1. A single one has weights 1 and
/// 0.
struct Field {
  std::array<Lattice, 2> lattice;
  std::array<double, 2> weight;
};

/// A shot at one adaptation luminance: `lattice` alone.
Field fixed_field(const Lattice& lattice) noexcept;

/// n = cos(pi f/2) n_k + sin(pi f/2) n_(k+1), k + f = log2(64 pitch), n_k of stream k: any pitch, from the
/// same lattices.
Field octave_field(double pitch, double time_pitch, std::uint64_t seed) noexcept;

/// The field at x, y degrees and t seconds.
double field_at(const Field& field, double x, double y, double t) noexcept;

}  // namespace scotopic::noise

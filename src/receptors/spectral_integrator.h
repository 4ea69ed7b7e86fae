// Rows of spectral bands to receptor signals: the inner loop of spectral images.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "receptors/spectral_weights.h"

namespace scotopic {

/// dual: sums in double, rounded once: relative error of a signal <= 6.1e-8. single: sums in float, <= 1e-6
/// up to 401 bands; where memory is the limit it is no faster. Both for non-negative bands; with negative
/// ones the errors are relative to the sum of magnitudes.
enum class Accumulation { single, dual };

/// One row of `count` pixels per signal, indexed by Signal. x, y and z may be null, all three or none.
using SignalRows = std::array<float*, signal_count>;

/// Weighs bands into signals. Immutable: share it between threads. Results do not depend on how pixels are
/// grouped into calls, nor on the machine's vector instructions. A value that is not finite makes all signals
/// of its pixel not finite or NaN; bands that no signal weighs must be left out by the caller (see
/// weighed_bands).
class SpectralIntegrator {
 public:
  /// Rounds the weights for its sums.
  SpectralIntegrator(const SpectralWeights& weights, Accumulation accumulation);

  /// Band b of pixel i is bands[b * stride + i].
  void integrate(const float* bands, std::size_t stride, std::size_t count,
                 const SignalRows& out) const noexcept;
  /// The same with IEEE 754 binary16 values.
  void integrate_half(const std::uint16_t* bands, std::size_t stride, std::size_t count,
                      const SignalRows& out) const noexcept;

  /// The weights as its loops read them.
  struct Weights {
    std::size_t bands = 0;
    /// [band][signal]; dual: rounded to 29 bits, so that a product with a float is exact in double, and a
    /// fused multiply-add gives the bits of an unfused one.
    std::vector<float> single;
    std::vector<double> dual;
    Accumulation accumulation = Accumulation::dual;
  };

 private:
  Weights weights_;
};

/// Which bands weigh anything at all: infrared and ultraviolet ones need not even be read.
std::vector<bool> weighed_bands(const SpectralWeights& weights);

}  // namespace scotopic

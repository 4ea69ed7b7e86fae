// Stage `noise` on rows of pixels.
#pragma once

#include <memory>

#include "batch/batch.h"
#include "stages/noise/field_rows.h"
#include "stages/noise/rod_noise.h"

namespace scotopic {

/// What the eye's receptors had of a row as it came in, before any stage changed it.
struct ReceivedRow {
  float* rod;    ///< luminance units per image unit; not finite where the pixel was not
  float* local;  ///< Lloc, cd/m2
};

/// Immutable: share it between threads (FieldRows are one a thread). Results depend neither on how pixels are
/// grouped into calls nor on the machine's vector instructions. single: pixels in float, error <= 2e-5 of the
/// pixel's light or its change, 3e-5 where v is what is left of a cancellation; dual: double inside, rounded
/// once, 2e-7 (tests/batch). The field is the same double in both.
class NoiseBatch {
 public:
  /// Parameters are taken to lie in their domains.
  explicit NoiseBatch(const RodNoiseParameters& parameters, Precision precision = Precision::single);
  ~NoiseBatch();

  /// What `apply` will ask of a row: rods (given, or estimated from RGB) and Lloc. Changes nothing of the
  /// row.
  void receive(const PixelRows& rows, const ReceivedRow& received) const noexcept;

  /// Adds noise in place to rows.count pixels, whose n are given. Where `touched` is given, touched[i]
  /// becomes 1 where pixel i changes. Pixels that are not finite, or had signals that are not, pass
  /// unchanged.
  void apply(const PixelRows& rows, const ReceivedRow& received, const double* field,
             std::uint8_t* touched = nullptr) const noexcept;

 private:
  struct Constants;
  std::unique_ptr<const Constants> constants_;
};

}  // namespace scotopic

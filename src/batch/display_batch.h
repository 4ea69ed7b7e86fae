// Stage `display` on rows of pixels.
#pragma once

#include <memory>

#include "batch/batch.h"
#include "stages/display/night_display.h"

namespace scotopic {

/// Immutable: share it between threads. Results depend neither on how pixels are grouped into calls nor on
/// the machine's vector instructions. single: error <= 4e-7 of the pixel's largest component of the result,
/// or 1e-7 of the peak; dual: double inside, rounded once (tests/batch).
class DisplayBatch {
 public:
  /// Parameters are taken to lie in their domains.
  explicit DisplayBatch(const NightDisplayParameters& parameters, Precision precision = Precision::single);
  ~DisplayBatch();

  /// Nothing is rescaled, and the pictures it is for hold nothing that would bend: what is within the
  /// display's gamut keeps its bits.
  bool keeps_range() const noexcept;

  /// In place. Where `touched` is given, touched[i] becomes 1 where pixel i changes, and stays as it is
  /// elsewhere. Pixels that are not finite pass unchanged.
  void apply(const PixelRows& rows, std::uint8_t* touched = nullptr) const noexcept;

 private:
  struct Constants;
  std::unique_ptr<const Constants> constants_;
};

}  // namespace scotopic

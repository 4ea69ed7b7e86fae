// The appearance operator on rows of pixels, in float: what the image tool runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "stages/shared/parameters.h"

namespace scotopic {

/// Rows of `count` pixels as separate planes, changed in place. RGB is linear, in units of white_luminance.
/// Receptor planes are optional (nullptr): absent cones are computed from RGB, absent rods estimated from it.
/// Receptor signals are in luminance units (MODEL: D65 of 1 cd/m2 has L+M = 1) per unit of white_luminance.
struct PixelRows {
  float* r = nullptr;
  float* g = nullptr;
  float* b = nullptr;
  const float* cone_l = nullptr;
  const float* cone_m = nullptr;
  const float* cone_s = nullptr;
  const float* rod = nullptr;
  std::size_t count = 0;
};

/// The same as IEEE 754 binary16; receptors are estimated from RGB.
struct HalfRows {
  std::uint16_t* r = nullptr;
  std::uint16_t* g = nullptr;
  std::uint16_t* b = nullptr;
  std::size_t count = 0;
};

/// Number type inside; planes are float either way. single: error <= 2e-6 of the pixel's largest component,
/// in or out, over 1e-6 to 1e6 cd/m2; 4e-6 with quadratic rods; 8e-6 for colours of no light, left over from
/// a cancellation (tests/appearance, tests/properties); colours whose luminance is the rest of a
/// cancellation, or with a negative cone signal, are computed in double. dual: double inside, rounded once.
enum class Precision { single, dual };

/// The operator with everything that does not depend on the pixel worked out once. Immutable: share it
/// between threads. Results depend neither on how pixels are grouped into calls nor on the machine's vector
/// instructions: no fused multiply-add, so every target gives the same bits.
class AppearanceBatch {
 public:
  /// Works out what does not depend on the pixel, in double. Parameters are taken to lie in their domains.
  explicit AppearanceBatch(const AppearanceParameters& parameters, Precision precision = Precision::single);
  ~AppearanceBatch();
  /// What is moved from can only be destroyed.
  AppearanceBatch(AppearanceBatch&&) noexcept;
  /// See above.
  AppearanceBatch& operator=(AppearanceBatch&&) noexcept;

  /// Applies the operator in place. Where `touched` is given (count bytes), touched[i] says whether pixel i
  /// was computed: 0 means it has the very bits it came in with (photopic, or not a finite number below
  /// 2^120).
  void apply(const PixelRows& rows, std::uint8_t* touched = nullptr) const noexcept;

  /// The same results rounded once more, to half (nearest, ties to even; beyond 65504, that).
  void apply(const HalfRows& rows, std::uint8_t* touched = nullptr) const noexcept;

  /// The same for pixels of R, G, B, A next to each other, as float or as half. A keeps its bits.
  void apply_rgba(float* rgba, std::size_t count, std::uint8_t* touched = nullptr) const noexcept;
  /// The same for pixels as half.
  void apply_rgba(std::uint16_t* half_rgba, std::size_t count,
                  std::uint8_t* touched = nullptr) const noexcept;

 private:
  struct Constants;
  std::unique_ptr<const Constants> constants_;
};

/// The vector instructions in use: "AVX3" (AVX-512), "AVX2", "SSE4", "NEON" ...
const char* simd_target() noexcept;

}  // namespace scotopic

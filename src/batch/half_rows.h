// Rows of halves to rows of floats and back, by the machine's vector instructions; the same bits on every
// machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scotopic {

/// Exactly, every bit of a NaN's payload among it.
void floats_from_halves(const std::uint16_t* halves, std::size_t count, float* out) noexcept;

/// Nearest, ties to even, as Imath::half rounds; but finite values beyond half's range become its largest, so
/// that no infinity is made. Infinities stay; NaN keeps the upper ten bits of its payload, and 1 where these
/// are 0.
void halves_from_floats(const float* values, std::size_t count, std::uint16_t* out) noexcept;

}  // namespace scotopic

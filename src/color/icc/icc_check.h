// ICC profiles looked through before a library parses them: what they say of themselves must fit into them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace scotopic {

/// Larger than any profile of an RGB device in use (the largest tables have some 3 MB).
inline constexpr std::size_t most_icc_bytes = std::size_t{64} << 20;

/// What is wrong with a profile by ICC.1:2010 (and v2): its size, signature and version, a tag that lies
/// outside of it or runs into another, text, curves and tables that are larger than their tag. Empty where
/// nothing is. Values are not looked at: they are numbers whichever bits they have.
std::string fault_of_icc(std::span<const std::byte> profile);

/// Whether bytes have the signature of an ICC profile, "acsp" at 36.
bool is_icc(std::span<const std::byte> bytes);

/// A component as a number that a profile's tables can be entered with: within +-1e4, and 0 for what is none.
inline float tame(float x) noexcept { return std::isfinite(x) ? std::clamp(x, -1e4f, 1e4f) : 0.0f; }

}  // namespace scotopic

// Philox4x32-10 (Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011;
// permutation as in their library Random123): random numbers by place. Any of them alone, in any order, on
// any machine: the same.
#pragma once

#include <array>
#include <cstdint>

namespace scotopic::noise {

using PhiloxWords = std::array<std::uint32_t, 4>;

/// Multipliers, and what keys grow by from round to round.
inline constexpr std::array<std::uint32_t, 2> philox_multipliers = {0xD2511F53, 0xCD9E8D57};
inline constexpr std::array<std::uint32_t, 2> philox_key_steps = {0x9E3779B9, 0xBB67AE85};
inline constexpr int philox_rounds = 10;

/// The key of the next round.
constexpr std::array<std::uint32_t, 2> next_philox_key(const std::array<std::uint32_t, 2>& key) noexcept {
  return {key[0] + philox_key_steps[0], key[1] + philox_key_steps[1]};
}

/// Four words of 32 random bits each.
constexpr PhiloxWords philox(PhiloxWords c, std::array<std::uint32_t, 2> key) noexcept {
  for (int round = 0; round < philox_rounds; ++round, key = next_philox_key(key)) {
    const std::uint64_t p0 = std::uint64_t{philox_multipliers[0]} * c[0];
    const std::uint64_t p1 = std::uint64_t{philox_multipliers[1]} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ key[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ key[1], static_cast<std::uint32_t>(p0)};
  }
  return c;
}

}  // namespace scotopic::noise

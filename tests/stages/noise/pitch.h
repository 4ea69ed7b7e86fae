// What the tests of the field share.
#pragma once

namespace scotopic::test {

/// Of a pool whose time constant is 0.1 s: its own correlation makes the pitch in time tau 151/315.
inline constexpr double time_pitch = 0.1 * 151 / 315;

}  // namespace scotopic::test

// How hosts read a cube between its nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernel/matrix3.h"

namespace scotopic {

/// Hosts take the four nodes of a tetrahedron (ffmpeg, OpenColorIO, Resolve on request), or the eight of a
/// cell.
enum class Reading { tetrahedral, trilinear };
inline constexpr std::array<Reading, 2> readings = {Reading::tetrahedral, Reading::trilinear};

/// Where a code lies in a cube of `edge` nodes a side, blue fastest: the cell's first node, and the way to
/// the next.
struct CubePoint {
  std::uint32_t cell = 0;
  std::array<float, 3> part{};
};

/// Codes are clamped to 0..1; a NaN is 0.
CubePoint cube_point(const Vec3<double>& code, std::size_t edge) noexcept;

/// The nodes that a reading takes, with their shares, which sum up to 1. Some may be 0.
struct NodeShares {
  std::array<std::uint32_t, 8> node{};
  std::array<double, 8> share{};
  std::size_t count = 0;
};
NodeShares node_shares(const CubePoint& point, std::size_t edge, Reading reading) noexcept;

/// What a reading of a cube gives for a code. `nodes`: edge^3 triplets, blue fastest.
Vec3<double> read_cube(std::span<const double> nodes, std::size_t edge, const Vec3<double>& code,
                       Reading reading) noexcept;

}  // namespace scotopic

#include "looks/cube/reading.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scotopic {
namespace {

/// From a cell's first node to the next along each axis.
std::array<std::uint32_t, 3> strides(std::size_t edge) noexcept {
  const auto n = static_cast<std::uint32_t>(edge);
  return {n * n, n, 1};
}

/// Along the axes in the order of how far the code is on its way along each.
NodeShares tetrahedral(const CubePoint& p, std::size_t edge) noexcept {
  const std::array<std::uint32_t, 3> stride = strides(edge);
  std::array<std::size_t, 3> axis = {0, 1, 2};
  const auto order = [&](std::size_t i, std::size_t j) {
    if (p.part[axis[i]] < p.part[axis[j]]) std::swap(axis[i], axis[j]);
  };
  order(0, 1), order(1, 2), order(0, 1);
  NodeShares out;
  out.count = 4;
  out.node[0] = p.cell;
  double before = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = static_cast<double>(p.part[axis[i]]);
    out.share[i] = before - part;
    out.node[i + 1] = out.node[i] + stride[axis[i]];
    before = part;
  }
  out.share[3] = before;
  return out;
}

NodeShares trilinear(const CubePoint& p, std::size_t edge) noexcept {
  const std::array<std::uint32_t, 3> stride = strides(edge);
  NodeShares out;
  out.count = 8;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    out.node[corner] = p.cell;
    out.share[corner] = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double part = static_cast<double>(p.part[axis]);
      const bool next = (corner >> axis & 1) != 0;
      out.node[corner] += next ? stride[axis] : 0;
      out.share[corner] *= next ? part : 1 - part;
    }
  }
  return out;
}

}  // namespace

CubePoint cube_point(const Vec3<double>& code, std::size_t edge) noexcept {
  const std::array<std::uint32_t, 3> stride = strides(edge);
  CubePoint out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(edge - 1);
    const double at = code[axis] > 0 ? std::min(code[axis], 1.0) * last : 0.0;
    const double first = std::min(std::floor(at), last - 1);
    out.cell += stride[axis] * static_cast<std::uint32_t>(first);
    out.part[axis] = static_cast<float>(at - first);
  }
  return out;
}

NodeShares node_shares(const CubePoint& point, std::size_t edge, Reading reading) noexcept {
  return reading == Reading::tetrahedral ? tetrahedral(point, edge) : trilinear(point, edge);
}

Vec3<double> read_cube(std::span<const double> nodes, std::size_t edge, const Vec3<double>& code,
                       Reading reading) noexcept {
  const NodeShares shares = node_shares(cube_point(code, edge), edge, reading);
  Vec3<double> out{};
  for (std::size_t i = 0; i < shares.count; ++i)
    for (std::size_t c = 0; c < 3; ++c) out[c] += shares.share[i] * nodes[3 * shares.node[i] + c];
  return out;
}

}  // namespace scotopic

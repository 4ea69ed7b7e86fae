#include "looks/cube/cube_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "looks/cube/metric.h"
#include "looks/cube/reading.h"

namespace scotopic {
namespace {

using NodeValues = std::vector<double>;

/// One colour of the fit.
struct FitPoint {
  CubePoint at;
  std::array<float, 3> wanted{};
  Metric metric{};
  double share = 1;   ///< of its set's weight
  double weight = 1;  ///< that it counts with
};

void add_points(std::vector<FitPoint>& points, const CubeGoal& goal, std::size_t edge,
                const FitColours& set) {
  Colours out = goal.exact(set.codes);
  for (auto* plane : {&out.r, &out.g, &out.b})
    for (float& x : *plane) x = x > 0 ? std::min(x, 1.f) : 0.f;
  const std::vector<Metric> metrics = local_metrics(goal, out);
  for (std::size_t i = 0; i < out.size(); ++i) {
    FitPoint p;
    p.at = cube_point({set.codes.r[i], set.codes.g[i], set.codes.b[i]}, edge);
    p.wanted = {out.r[i], out.g[i], out.b[i]};
    p.metric = metrics[i];
    p.share = p.weight = set.weight / static_cast<double>(out.size());
    points.push_back(p);
  }
}

/// The sum over colours and readings of weight * difference^2, as a quadratic form of the nodes.
class Misfit {
 public:
  Misfit(const CubeGoal& goal, std::size_t edge, const std::vector<FitColours>& sets, const NodeValues& held,
         double hold)
      : edge_(edge), held_(held) {
    for (const FitColours& set : sets) add_points(points_, goal, edge, set);
    // Neighbours in the cube are neighbours in memory.
    std::stable_sort(points_.begin(), points_.end(),
                     [](const auto& a, const auto& b) { return a.at.cell < b.at.cell; });
    hold_ = hold * mean_weight();
  }

  /// Counts each colour by 1/its difference, the worse of its readings: the sum of squares becomes one of
  /// differences (iteratively reweighted least squares), so a few that no node can hold do not spoil the
  /// rest.
  void count_differences(const NodeValues& nodes) {
    constexpr double scale = 0.1, floor = 0.01;  // CIEDE2000; by trial. Below the floor all is well.
    for (FitPoint& p : points_) {
      double worse = 0;
      for (const Reading reading : readings) {
        const Vec3<double> d = difference(p, value(nodes, node_shares(p.at, edge_, reading)));
        worse = std::max(worse, dot(d, p.metric * d));
      }
      p.weight = p.share * scale / (std::sqrt(worse) + floor);
    }
  }

  /// Half the gradient, negative: where the nodes are to go.
  NodeValues downhill(const NodeValues& nodes) const {
    NodeValues out(nodes.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = hold_ * (held_[i] - nodes[i]);
    for (const FitPoint& p : points_)
      for (const Reading reading : readings) {
        const NodeShares shares = node_shares(p.at, edge_, reading);
        const Vec3<double> d = difference(p, value(nodes, shares));
        spread(out, shares, p.metric * d, p.weight);
      }
    return out;
  }

  /// The form's matrix times a direction.
  NodeValues times(const NodeValues& direction) const {
    NodeValues out(direction.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = hold_ * direction[i];
    for (const FitPoint& p : points_)
      for (const Reading reading : readings) {
        const NodeShares shares = node_shares(p.at, edge_, reading);
        spread(out, shares, p.metric * value(direction, shares), p.weight);
      }
    return out;
  }

  /// The matrix's diagonal.
  NodeValues diagonal(std::size_t size) const {
    NodeValues out(size, hold_);
    for (const FitPoint& p : points_)
      for (const Reading reading : readings) {
        const NodeShares shares = node_shares(p.at, edge_, reading);
        for (std::size_t i = 0; i < shares.count; ++i)
          for (std::size_t c = 0; c < 3; ++c)
            out[3 * shares.node[i] + c] +=
                p.weight * shares.share[i] * shares.share[i] * static_cast<double>(p.metric[c]);
      }
    return out;
  }

 private:
  /// Of a code's element, on average over colours: what `hold` is a share of.
  double mean_weight() const {
    double sum = 0;
    for (const FitPoint& p : points_)
      sum += p.weight * static_cast<double>(p.metric[0] + p.metric[1] + p.metric[2]) / 3;
    return points_.empty() ? 1 : sum / static_cast<double>(points_.size());
  }
  static Vec3<double> value(const NodeValues& nodes, const NodeShares& shares) {
    Vec3<double> out{};
    for (std::size_t i = 0; i < shares.count; ++i)
      for (std::size_t c = 0; c < 3; ++c) out[c] += shares.share[i] * nodes[3 * shares.node[i] + c];
    return out;
  }
  static Vec3<double> difference(const FitPoint& p, const Vec3<double>& got) {
    Vec3<double> out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<double>(p.wanted[c]) - got[c];
    return out;
  }
  static void spread(NodeValues& out, const NodeShares& shares, const Vec3<double>& v, double weight) {
    for (std::size_t i = 0; i < shares.count; ++i)
      for (std::size_t c = 0; c < 3; ++c) out[3 * shares.node[i] + c] += weight * shares.share[i] * v[c];
  }

  std::size_t edge_;
  const NodeValues& held_;
  double hold_ = 0;
  std::vector<FitPoint> points_;
};

double product(const NodeValues& a, const NodeValues& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

NodeValues quotient(const NodeValues& a, const NodeValues& b) {
  NodeValues out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] / b[i];
  return out;
}

/// Hestenes & Stiefel 1952, with the diagonal as preconditioner.
void descend(NodeValues& nodes, const Misfit& misfit, int steps) {
  const NodeValues diagonal = misfit.diagonal(nodes.size());
  NodeValues r = misfit.downhill(nodes), z = quotient(r, diagonal), p = z;
  double rz = product(r, z);
  for (int step = 0; step < steps && rz > 0; ++step) {
    const NodeValues ap = misfit.times(p);
    const double length = rz / product(p, ap);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      nodes[i] += length * p[i];
      r[i] -= length * ap[i];
    }
    z = quotient(r, diagonal);
    const double next = product(r, z);
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
}

}  // namespace

std::vector<double> sampled_nodes(const CubeGoal& goal, std::size_t edge) {
  Colours codes;
  const auto code = [&](std::size_t i) {
    return static_cast<float>(static_cast<double>(i) / static_cast<double>(edge - 1));
  };
  for (std::size_t i = 0; i < edge; ++i)
    for (std::size_t j = 0; j < edge; ++j)
      for (std::size_t k = 0; k < edge; ++k) {
        codes.r.push_back(code(i));
        codes.g.push_back(code(j));
        codes.b.push_back(code(k));
      }
  const Colours out = goal.exact(codes);
  NodeValues nodes;
  nodes.reserve(3 * out.size());
  for (std::size_t n = 0; n < out.size(); ++n)
    for (const float x : {out.r[n], out.g[n], out.b[n]})
      nodes.push_back(x > 0 ? std::min(static_cast<double>(x), 1.0) : 0.0);
  return nodes;
}

std::vector<double> fitted_nodes(const CubeGoal& goal, std::size_t edge, std::vector<double> nodes,
                                 const std::vector<FitColours>& sets, const FitOptions& options) {
  const NodeValues held = nodes;
  Misfit misfit(goal, edge, sets, held, options.hold);
  descend(nodes, misfit, options.steps);
  for (int round = 0; round < options.rounds; ++round) {
    misfit.count_differences(nodes);
    descend(nodes, misfit, options.steps / 2);
  }
  for (double& x : nodes) x = std::clamp(x, -nodes_beyond, 1 + nodes_beyond);
  return nodes;
}

}  // namespace scotopic

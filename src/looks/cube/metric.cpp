#include "looks/cube/metric.h"

#include <algorithm>
#include <cmath>

namespace scotopic {
namespace {

constexpr float step =
    0.000244140625f;               // of a code, 2^-12: small beside what bends, large beside float's rounding
constexpr double floor_of = 1e-3;  // of the largest diagonal element, added: no direction is free

// Along the axes and between each two of them.
constexpr std::array<std::array<float, 3>, 6> directions = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};

Colours moved(const Colours& out, const std::array<float, 3>& direction, float by) {
  Colours c = out;
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.r[i] += by * direction[0];
    c.g[i] += by * direction[1];
    c.b[i] += by * direction[2];
  }
  return c;
}

/// Whether it has a Cholesky factor: no change makes a negative square.
bool is_positive(const Metric& metric) {
  const auto m = [&](std::size_t i) { return static_cast<double>(metric[i]); };
  if (!(m(0) > 0)) return false;
  const double l10 = m(3) / m(0), l20 = m(4) / m(0);
  const double d1 = m(1) - l10 * m(3);
  if (!(d1 > 0)) return false;
  const double l21 = (m(5) - l20 * m(3)) / d1;
  return m(2) - l20 * m(4) - l21 * l21 * d1 > 0;
}

/// CIEDE2000 is no square of a length: what is left of that over a step must not turn a minimum into a
/// saddle.
Metric made_positive(Metric m) {
  for (int tries = 0; tries < 20 && !is_positive(m); ++tries)
    for (std::size_t i = 3; i < 6; ++i) m[i] *= 0.9f;
  return is_positive(m) ? m : Metric{m[0], m[1], m[2], 0, 0, 0};
}

/// By the parallelogram law, from the squares along the six directions.
Metric metric_of(const std::array<double, 6>& q) {
  const double floor = floor_of * std::max({q[0], q[1], q[2]});
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(q[0] + floor),
          f(q[1] + floor),
          f(q[2] + floor),
          f((q[3] - q[0] - q[1]) / 2),
          f((q[4] - q[0] - q[2]) / 2),
          f((q[5] - q[1] - q[2]) / 2)};
}

}  // namespace

std::vector<Metric> local_metrics(const CubeGoal& goal, const Colours& out) {
  const std::vector<Vec3<double>> here = goal.seen(out);
  std::vector<std::array<double, 6>> squares(out.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    for (const float by : {step, -step}) {
      const std::vector<Vec3<double>> there = goal.seen(moved(out, directions[k], by));
      for (std::size_t i = 0; i < squares.size(); ++i) {
        const double d = goal.difference()(here[i], there[i]) / static_cast<double>(step);
        squares[i][k] += std::isfinite(d) ? d * d / 2 : 0;
      }
    }
  }
  std::vector<Metric> metrics;
  metrics.reserve(squares.size());
  for (const auto& q : squares) metrics.push_back(made_positive(metric_of(q)));
  return metrics;
}

}  // namespace scotopic

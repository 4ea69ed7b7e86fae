// How a cube is read between its nodes, beside OpenColorIO's reading.
#include "looks/cube/reading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "looks/chain/chain.h"
#include "looks/chain/ocio_chain.h"

namespace scotopic {
namespace {

namespace OCIO = OCIO_NAMESPACE;

constexpr std::size_t edge = 9;

std::vector<double> random_nodes() {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> value(0, 1);
  std::vector<double> nodes(3 * edge * edge * edge);
  for (double& x : nodes) x = static_cast<double>(value(engine));
  return nodes;
}

/// Inside cells, on their faces and edges, at nodes, beyond the ends.
std::vector<Vec3<double>> codes() {
  std::vector<Vec3<double>> out = {{0, 0, 0}, {1, 1, 1}, {0.5, 0.5, 0.5}, {0.125, 0.3, 0.3}, {-0.5, 0.4, 2}};
  std::mt19937 engine(11);
  std::uniform_real_distribution<float> value(0, 1);
  for (int i = 0; i < 2000; ++i)
    out.push_back({static_cast<double>(value(engine)), static_cast<double>(value(engine)),
                   static_cast<double>(value(engine))});
  return out;
}

TEST(Reading, shares_sum_up_to_one_and_none_is_negative) {
  for (const Reading reading : readings)
    for (const Vec3<double>& code : codes()) {
      const NodeShares shares = node_shares(cube_point(code, edge), edge, reading);
      double sum = 0;
      for (std::size_t i = 0; i < shares.count; ++i) {
        EXPECT_GE(shares.share[i], 0);
        EXPECT_TRUE(shares.node[i] < edge * edge * edge || shares.share[i] == 0) << shares.node[i];
        sum += shares.share[i];
      }
      EXPECT_NEAR(sum, 1, 1e-12);
    }
}

TEST(Reading, a_node_gives_what_it_holds) {
  const std::vector<double> nodes = random_nodes();
  for (const Reading reading : readings)
    for (std::size_t n = 0; n < edge * edge * edge; ++n) {
      const auto at = [](std::size_t i) { return static_cast<double>(i) / static_cast<double>(edge - 1); };
      const Vec3<double> code = {at(n / (edge * edge)), at(n / edge % edge), at(n % edge)};
      const Vec3<double> got = read_cube(nodes, edge, code, reading);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], nodes[3 * n + c], 1e-12);
    }
}

TEST(Reading, is_opencolorio_s_reading) {
  Chain chain;
  chain.steps = {Lut3DStep{edge, random_nodes(), 7}};
  const auto raw = OCIO::Config::CreateRaw();
  const std::vector<double>& nodes = std::get<Lut3DStep>(chain.steps[0]).values;
  for (const auto& [reading, name] : {std::pair(Reading::tetrahedral, OCIO::INTERP_TETRAHEDRAL),
                                      std::pair(Reading::trilinear, OCIO::INTERP_LINEAR)}) {
    const auto processor = cpu_processor(ocio_transform(chain, name), raw);
    double worst = 0;
    for (const Vec3<double>& code : codes()) {
      float p[3] = {static_cast<float>(code[0]), static_cast<float>(code[1]), static_cast<float>(code[2])};
      processor->applyRGB(p);
      const Vec3<double> got = read_cube(nodes, edge, code, reading);
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(got[c] - static_cast<double>(p[c])));
    }
    std::printf("largest difference to OpenColorIO %.1e\n", worst);
    EXPECT_LE(worst, 1e-5);  // its float
  }
}

}  // namespace
}  // namespace scotopic

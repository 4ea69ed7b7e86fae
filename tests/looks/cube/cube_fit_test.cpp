// Fitted nodes beside sampled ones, in the figures that the files state.
#include "looks/cube/cube_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "looks/cube/baked_cube.h"
#include "looks/cube/cube_colours.h"
#include "looks/cube/cubes.h"
#include "looks/cube/metric.h"

namespace scotopic {
namespace {

TEST(Metric, is_the_square_of_a_small_difference) {
  const ColourConfig config = ColourConfig::own();
  const CubeGoal goal(test::cube_spec("ACEScct", 0.1, 33), config);
  const Colours out = {{0.41f, 0.3f, 0.5f}, {0.41f, 0.35f, 0.3f}, {0.41f, 0.4f, 0.2f}};
  const std::vector<Metric> metrics = local_metrics(goal, out);
  for (const Vec3<double>& d :
       {Vec3<double>{2e-4, 0, 0}, {0, -2e-4, 1e-4}, {1e-4, 1e-4, 1e-4}, {-2e-4, 1e-4, 2e-4}}) {
    Colours moved = out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      moved.r[i] += static_cast<float>(d[0]);
      moved.g[i] += static_cast<float>(d[1]);
      moved.b[i] += static_cast<float>(d[2]);
    }
    const auto a = goal.seen(out), b = goal.seen(moved);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double by_metric = std::sqrt(dot(d, metrics[i] * d)),
                   by_difference = goal.difference()(a[i], b[i]);
      EXPECT_NEAR(by_metric, by_difference, 0.05 * by_difference + 1e-3) << i;
    }
  }
}

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t largest_edge = 33;  // minutes else
#else
constexpr std::size_t largest_edge = 65;
#endif

struct Row {
  const char* space;
  double adaptation;
  std::size_t edge;
  bool night;
  double mean, p99, max;  // that the fitted cube must keep over Rec.709 colours, in either reading
};
// What is asked of 65 nodes: 0.02, 0.25, 5 in ACEScct; four times that of 33.
const Row rows[] = {
    {"ACEScct", 0.1, 33, false, 0.08, 1.0, 20},
    {"ACEScct", 1, 33, false, 0.08, 1.0, 20},
    {"ACEScct", 0.01, 33, false, 0.08, 1.0, 20},
    {"DaVinci Intermediate WideGamut", 0.1, 33, false, 0.11, 1.0, 20},
    {"ACEScct", 0.1, 33, true, 0.2, 2.0, 5},
    {"S-Log3 S-Gamut3.Cine", 0.1, 33, false, 0.15, 2.0, 15},
    {"ACEScct", 0.1, 65, false, 0.0215, 0.25, 5},
};

TEST(CubeFit, fitted_cubes_are_nearer_than_sampled_ones_and_as_near_as_asked) {
  const ColourConfig config = ColourConfig::own();
  for (const Row& row : rows) {
    if (row.edge > largest_edge) continue;
    const LookSpec spec = row.night ? test::night_cube_spec(row.space, row.adaptation, row.edge)
                                    : test::cube_spec(row.space, row.adaptation, row.edge);
    const BakedCube sampled = bake_cube(spec, config, false), fitted = bake_cube(spec, config);
    for (std::size_t k = 0; k < readings.size(); ++k) {
      const BakeError &before = sampled.error.rec709.by_reading[k],
                      &after = fitted.error.rec709.by_reading[k];
      std::printf("%-32s %zu La %-5g %s %s: %.3f/%.2f/%.1f -> %.3f/%.2f/%.1f\n", row.space, row.edge,
                  row.adaptation, row.night ? "night" : "light", k == 0 ? "tetrahedral" : "trilinear  ",
                  before.mean, before.p99, before.max, after.mean, after.p99, after.max);
      EXPECT_LT(after.mean, 0.9 * before.mean) << row.space;
      EXPECT_LE(after.mean, row.mean) << row.space << " " << row.edge;
      EXPECT_LE(after.p99, row.p99) << row.space << " " << row.edge;
      EXPECT_LE(after.max, row.max) << row.space << " " << row.edge;
    }
  }
}

TEST(CubeFit, is_the_same_twice_stays_within_codes_and_leaves_nodes_that_no_colour_reaches) {
  const ColourConfig config = ColourConfig::own();
  const LookSpec spec = test::cube_spec("ACEScct", 0.1, 17);
  const BakedCube one = bake_cube(spec, config), other = bake_cube(spec, config),
                  sampled = bake_cube(spec, config, false);
  const std::vector<double>&a = std::get<Lut3DStep>(one.chain.steps[1]).values,
        &b = std::get<Lut3DStep>(other.chain.steps[1]).values,
        &raw = std::get<Lut3DStep>(sampled.chain.steps[1]).values;
  EXPECT_EQ(a, b);
  EXPECT_GE(*std::min_element(a.begin(), a.end()), 0);
  EXPECT_LE(*std::max_element(a.begin(), a.end()), 1);
  // Red alone at the top, green and blue at 0 of it: far outside AP1 at this brightness.
  const std::size_t corner = 3 * (16 * 17 * 17);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(a[corner + c], raw[corner + c]);
}

TEST(CubeColours, are_codes_in_0_to_1_of_light_within_the_stops) {
  const ColourConfig config = ColourConfig::own();
  const CubeGoal goal(test::cube_spec("sRGB - Texture", 0.1, 17), config);
  const CodedColours set = coded_colours(goal, gamut_xyz_matrix("rec709").value(), config.xyz_from_working(),
                                         10000, {cube_darkest, cube_brightest});
  // 5 of 13 stops are brighter than code 1.
  EXPECT_NEAR(set.without_code, 5.0 / 13, 0.01);
  const Colours light = goal.light(set.codes);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float largest = std::max({light.r[i], light.g[i], light.b[i]});
    EXPECT_GE(largest, 0.00389f);
    EXPECT_LE(largest, 1.0001f);
  }
}

std::string figures(const BakeError& e, double code) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f / %.2f / %.1f, %.3f", e.mean, e.p99, e.max, code);
  return text;
}

void print_row(const LookSpec& spec, const char* what, const ColourConfig& config) {
  const BakedCube sampled = bake_cube(spec, config, false), fitted = bake_cube(spec, config);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    std::printf("| %s | %zu³ | %s | %s |", spec.space.c_str(), spec.edge, what,
                k == 0 ? "tetrahedral" : "trilinear");
    for (const BakedCube* cube : {&sampled, &fitted})
      std::printf(" %s |",
                  figures(cube->error.rec709.by_reading[k], cube->error.rec709.worst_code[k]).c_str());
    std::printf(" %s |\n", figures(fitted.error.own.by_reading[k], fitted.error.own.worst_code[k]).c_str());
    std::fflush(stdout);
  }
}

// The table of docs/cubes.md. Minutes: --gtest_also_run_disabled_tests --gtest_filter='CubeTable*'
TEST(CubeTable, DISABLED_of_every_space) {
  const ColourConfig config = ColourConfig::own();
  for (const char* space : {"ACEScct", "DaVinci Intermediate WideGamut", "ARRI LogC3 (EI800)", "ARRI LogC4",
                            "Apple Log", "CanonLog3 CinemaGamut D55", "V-Log V-Gamut",
                            "Log3G10 REDWideGamutRGB", "S-Log3 S-Gamut3.Cine", "sRGB - Texture"})
    for (const std::size_t edge : {33, 65}) {
      for (const double la : {1.0, 0.1, 0.01}) {
        const std::string what = "La " + std::to_string(la).substr(0, la < 0.1 ? 4 : la < 1 ? 3 : 1);
        print_row(test::cube_spec(space, la, edge), what.c_str(), config);
      }
      print_row(test::night_cube_spec(space, 0.1, edge), "night 0.1", config);
    }
}

}  // namespace
}  // namespace scotopic

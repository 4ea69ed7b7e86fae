// A picture on its way through the filter: bands, threads, instruction sets and what is left out do not show.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "stages/glare/filter.h"
#include "stages/glare/judge.h"

namespace scotopic {
namespace {

using test::filtered;
using test::night;
using test::parameters;
using test::Picture;
using test::Plane;
using test::same_bits;

TEST(GlareRun, threads_do_not_show) {
  Picture in = night(211, 420, 40);
  for (const bool hole : {false, true}) {
    if (hole) in.planes[0](100, 128) = std::nanf("");
    const Picture one = filtered(parameters(211, 420), in);
    for (const int n : {2, 5})
      EXPECT_TRUE(same_bits(one, filtered(parameters(211, 420), in, test::threads(n)))) << n;
    const ParallelFor backwards = [](int count, const std::function<void(int)>& task) {
      for (int i = count; i-- > 0;) task(i);
    };
    EXPECT_TRUE(same_bits(one, filtered(parameters(211, 420), in, backwards)));
  }
}

TEST(GlareRun, instruction_sets_do_not_show) {
  Picture in = night(211, 150, 40);
  in.planes[0](100, 128) = std::nanf("");
  GlareParameters odd = parameters(211, 150);
  odd.grid.ppd_x = 13;
  const auto choose = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  };
  for (const GlareParameters& p : {parameters(211, 150), parameters(211, 150, 20, GlareRule::all), odd}) {
    choose(0);
    const Picture best = filtered(p, in);
    int sets = 0;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1, ++sets) {
      choose(left & -left);
      EXPECT_TRUE(same_bits(best, filtered(p, in))) << hwy::TargetName(left & -left);
    }
    choose(0);
    EXPECT_GE(sets, 1);
  }
}

// Where nothing near is lit the filter leaves rungs out; the bare pyramid does not.
void leaves_out_zeros_only(const GlareGrid& grid) {
  GlareParameters p = parameters(grid.width, grid.height);
  p.grid = grid;
  Picture in(grid.width, grid.height);
  const int right = grid.width - 1;
  const std::pair<int, int> lamps[] = {{0, 0},     {right, 2}, {63, 127},      {64, 40},
                                       {126, 128}, {192, 149}, {255, 75},      {256, 90},
                                       {257, 104}, {1, 60},    {right - 4, 20}};
  for (Plane& plane : in.planes)
    for (const auto& [x, y] : lamps) plane(x, y) = 1000;
  Plane excess = in.planes[0];
  for (float& x : excess.values) x = std::max(0.0f, x - 1);
  const Plane come = test::convolved(GlareFunction({}), grid, excess);
  const Picture out = filtered(p, in);
  for (std::size_t i = 0; i < come.values.size(); ++i)
    if (excess.values[i] == 0) {
      EXPECT_EQ(out.planes[1].values[i], come.values[i])
          << grid.width << " wide: " << i % static_cast<std::size_t>(grid.width) << " "
          << i / static_cast<std::size_t>(grid.width);
    }
}

TEST(GlareRun, what_is_left_out_would_have_been_zero) {
  for (const GlareSides sides : {GlareSides::end, GlareSides::meet})
    for (const double ppd_x : {8.0, 16.0})
      // The last step of 64 samples whole, and narrower than a rung reaches.
      for (const int width : {320, 322, 325}) leaves_out_zeros_only({width, 150, ppd_x, 8, sides, 1});
}

TEST(GlareRun, memory_is_planned) {
  // 8K, three planes: below the program's limit of 4 GiB with the picture itself.
  const GlareFilter filter(parameters(7680, 4320, 192));
  const double per_pixel = static_cast<double>(filter.bytes(3, 2)) / (7680.0 * 4320.0);
  std::printf("  8K, three planes: %.1f bytes a pixel, %.0f MB\n", per_pixel, per_pixel * 7680 * 4320 / 1e6);
  EXPECT_GT(per_pixel, 7);
  EXPECT_LT(per_pixel, 10);
}

}  // namespace
}  // namespace scotopic

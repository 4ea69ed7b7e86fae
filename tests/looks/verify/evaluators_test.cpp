#include "looks/verify/evaluators.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "support/primaries.h"

namespace scotopic {
namespace {

AppearanceParameters at(double adaptation) {
  AppearanceParameters p;
  p.adaptation = adaptation;
  p.white_luminance = adaptation / 0.18;
  p.xyz_from_rgb = test::rec709;
  p.xyz_from_gamut = test::rec709;
  return p;
}

Colours colours(std::size_t count) { return stop_colours(count, test::rec709, test::rec709); }

TEST(Evaluators, each_is_as_exact_as_it_says) {
  struct Row {
    const char* kind;
    double pixel;       // of the pixel's largest component
    double difference;  // CIEDE2000 of 99 % of the colours
  };
  // double: one rounding to float. float: the figure asked for. LUTs: about twice what was measured.
  constexpr Row rows[] = {{"double", 6.0e-8, 1e-5},
                          {"float", 5e-7, 2e-5},
                          {"lut65", 0.02, 0.1},
                          {"lut33", 0.06, 0.4},
                          {"lut17", 0.15, 1.5}};
  for (const double adaptation : {0.001, 0.01, 0.1, 1.0})
    for (const Row& row : rows) {
      const PreparedEvaluator kind = prepare_evaluator(at(adaptation), evaluator_named(row.kind));
      const EvaluatorError error = evaluator_error(at(adaptation), kind.apply, colours(20000));
      const WorstPixel& worst = error.worst.front();
      std::printf(
          "La %-6g %-7s pixel %.3g, dE00 %.3g (99 %% %.3g), %.3g float ulps; worst (%.9g, %.9g, %.9g)\n",
          adaptation, row.kind, error.pixel.max, error.difference.max, error.difference.p99,
          error.component.max, worst.in[0], worst.in[1], worst.in[2]);
      EXPECT_LE(error.pixel.max, row.pixel) << row.kind;
      EXPECT_LE(error.difference.p99, row.difference) << row.kind;
      EXPECT_DOUBLE_EQ(worst.error, error.pixel.max);
    }
}

TEST(Evaluators, double_is_within_an_ulp_of_float_in_every_component) {
  for (const double adaptation : {0.001, 0.01, 0.1, 1.0, 4.9}) {
    const PreparedEvaluator kind = prepare_evaluator(at(adaptation), evaluator_named("double"));
    const EvaluatorError error = evaluator_error(at(adaptation), kind.apply, colours(50000));
    std::printf("La %-6g %.9f float ulps\n", adaptation, error.component.max);
    EXPECT_LE(error.component.max, 1);
  }
}

TEST(Evaluators, a_finer_lut_is_closer) {
  double coarser = std::numeric_limits<double>::infinity();
  for (const char* name : {"lut17", "lut33", "lut65"}) {
    const EvaluatorError error =
        evaluator_error(at(0.05), prepare_evaluator(at(0.05), evaluator_named(name)).apply, colours(20000));
    EXPECT_LT(error.difference.mean, 0.6 * coarser) << name;
    coarser = error.difference.mean;
  }
}

TEST(Evaluators, every_way_leaves_photopic_and_non_finite_pixels_alone_bit_for_bit) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const float nan = std::bit_cast<float>(0x7fa12345u);  // signalling, with a payload
  const auto p = at(0.1);
  const auto photopic = static_cast<float>(5 / p.white_luminance);
  Colours in;
  for (const float odd : {nan, inf, -inf, 3e38f, photopic, 2 * photopic})
    for (int position = 0; position < 3; ++position) {
      in.r.push_back(position == 0 || odd == photopic ? odd : 0.01f);
      in.g.push_back(position == 1 || odd == photopic || odd == 2 * photopic ? odd : 0.01f);
      in.b.push_back(position == 2 || odd == photopic ? odd : 0.01f);
    }
  for (const EvaluatorKind& kind : evaluator_kinds) {
    if (kind.edge == 129) continue;  // as lut65, and slow to bake
    Colours out = in;
    std::vector<std::uint8_t> touched(in.size(), 9);
    prepare_evaluator(p, kind).apply(rows_of(out), touched.data());
    for (std::size_t i = 0; i < in.size(); ++i) {
      EXPECT_EQ(touched[i], 0) << kind.name << ' ' << i;
      for (const auto& [before, after] : {std::pair(&in.r, &out.r), {&in.g, &out.g}, {&in.b, &out.b}})
        EXPECT_EQ(std::memcmp(&(*before)[i], &(*after)[i], sizeof(float)), 0) << kind.name << ' ' << i;
    }
  }
}

TEST(Evaluators, all_touch_the_same_pixels) {
  const auto p = at(0.5);
  const Colours in = colours(5000);
  std::vector<std::uint8_t> expected(in.size());
  Colours work = in;
  prepare_evaluator(p, evaluator_named("float")).apply(rows_of(work), expected.data());
  EXPECT_GT(std::count(expected.begin(), expected.end(), 0), 500);
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 500);
  std::vector<std::uint8_t> touched(in.size());
  work = in;
  prepare_evaluator(p, evaluator_named("lut17")).apply(rows_of(work), touched.data());
  EXPECT_EQ(touched, expected);
}

TEST(Evaluators, statistics_are_those_of_the_numbers) {
  std::vector<double> numbers;
  for (int i = 1; i <= 1000; ++i) numbers.push_back(i);
  const ErrorStatistics s = statistics_of(numbers);
  EXPECT_DOUBLE_EQ(s.mean, 500.5);
  EXPECT_DOUBLE_EQ(s.p99, 991);
  EXPECT_DOUBLE_EQ(s.max, 1000);
  EXPECT_EQ(statistics_of({}).max, 0);
}

}  // namespace
}  // namespace scotopic

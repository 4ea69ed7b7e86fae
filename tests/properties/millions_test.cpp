// Pixels of every regime under drawn settings, each way of computing them against exact arithmetic.
//   SCOTOPIC_DRAWS=1e7    the long form (default 1e6)
//   SCOTOPIC_SEED=N       other draws
//   SCOTOPIC_WORST=FILE   writes the worst of each regime and way, in the form of worst.csv
//   SCOTOPIC_HISTOGRAM=FILE  writes how many pixels fell into each octave of error
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "properties/judge.h"

namespace scotopic::test {
namespace {

constexpr std::size_t ways = static_cast<std::size_t>(Way::count);
using Table = std::array<std::array<Worst, ways>, regime_count>;

double from_environment(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtod(text, nullptr) : otherwise;
}

bool same_bits(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return std::bit_cast<std::array<std::uint32_t, 3>>(a) == std::bit_cast<std::array<std::uint32_t, 3>>(b);
}

struct Failures {
  long above_bound = 0, components_above_bound = 0, components_far_above = 0, changed_untouched = 0;
  std::string first, first_component;
};

// What was drawn: of each regime how many, how many of them so ill-conditioned that 1e-6 and more is allowed
// in double, too, and the largest allowance; of each threshold, how many within 8 ulp of it.
struct Coverage {
  std::array<long, regime_count> drawn{}, lenient{};
  std::array<double, regime_count> most{};
  std::array<long, threshold_count> at{};

  void add(Regime regime, const OperatorConstants& c, const Sample& sample, Planes planes,
           const Strain& strained) {
    const auto r = static_cast<std::size_t>(regime);
    const double allowed = allowed_in_double(strained);
    ++drawn[r];
    if (allowed > 1e-6) ++lenient[r];
    most[r] = std::max(most[r], allowed);
    for (int t = 0; t < threshold_count; ++t) {
      const auto threshold = static_cast<Threshold>(t);
      if (threshold == Threshold::face && regime != Regime::projection_face) continue;  // costly
      if (is_at(threshold, c, sample, planes)) ++at[static_cast<std::size_t>(t)];
    }
  }
};

// Light, of which every component counts by itself.
bool is_light(Regime regime) {
  constexpr std::array light = {Regime::ordinary,      Regime::grey,
                                Regime::equal_cones,   Regime::threshold_photopic,
                                Regime::opponent_zero, Regime::threshold_scotopic};
  return std::find(light.begin(), light.end(), regime) != light.end();
}

void note(Worst& worst, double error, Planes planes, const AppearanceParameters& p, const Sample& sample) {
  const int octave = error > 0 ? std::min(63, std::max(0, 60 + std::ilogb(error))) : 0;
  ++worst.octaves[static_cast<std::size_t>(octave)];
  if (error > worst.error) {
    worst.error = error, worst.planes = planes, worst.sample = sample;
    worst.setting = to_text(p);
  }
}

// One setting, `each` pixels of each regime, by all ways.
void judge_setting(Random& random, int each, Table& table, Failures& failures, Coverage& coverage) {
  const AppearanceParameters p = draw_parameters(random);
  const Planes planes = draw_planes(random);
  const Evaluators way(p);
  const ExactOperator<long double> exact(p);
  std::vector<Sample> samples;
  for (int regime = 0; regime < regime_count; ++regime)
    for (int k = 0; k < each; ++k)
      samples.push_back(draw(static_cast<Regime>(regime), way.reference.constants(), random));
  Rows single(samples), dual(samples);
  std::vector<std::uint8_t> touched_single(samples.size()), touched_dual(samples.size());
  way.single.apply(single.view(planes), touched_single.data());
  way.dual.apply(dual.view(planes), touched_dual.data());

  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    const auto pixel = sample.widened(planes);
    const Summed<long double> expected = exact.with_terms(pixel);
    const auto regime = static_cast<Regime>(i / static_cast<std::size_t>(each));
    const auto widen = [](const std::array<float, 3>& v) { return Vec3<double>{v[0], v[1], v[2]}; };
    const std::array<Vec3<double>, ways> got = {way.reference(pixel), widen(single.rgb(i)),
                                                widen(dual.rgb(i))};
    const Strain strained = strain(way.reference.constants(), sample, planes);
    coverage.add(regime, way.reference.constants(), sample, planes, strained);
    for (std::size_t w = 0; w < ways; ++w) {
      const auto this_way = static_cast<Way>(w);
      const double error = relative_error(got[w], expected.value, sample, planes, this_way);
      const double component = component_error(got[w], expected, this_way);
      Worst& worst = table[static_cast<std::size_t>(regime)][w];
      note(worst, error, planes, p, sample);
      if (!strained.cancelled) worst.component = std::max(worst.component, component);
      const auto where = [&] {
        return to_text(regime, this_way, {error, component, planes, to_text(p), sample, {}});
      };
      if (!(error <= allowed_error(this_way, p.rods, strained)) && failures.above_bound++ == 0)
        failures.first = where();
      if (!is_light(regime) || strained.cancelled) continue;
      if (!(component <= allowed_component_error(this_way))) ++failures.components_above_bound;
      if (!(component <= 10 * allowed_component_error(this_way)) && failures.components_far_above++ == 0)
        failures.first_component = where();
    }
    if (!touched_single[i] && !same_bits(single.rgb(i), sample.rgb)) ++failures.changed_untouched;
    if (!touched_dual[i] && !same_bits(dual.rgb(i), sample.rgb)) ++failures.changed_untouched;
  }
}

void write_histogram(const Table& table, const char* path) {
  std::ofstream file(path);
  file << "# log2 of the relative error";
  for (const char* way : way_names) file << ',' << way;
  file << '\n';
  for (std::size_t octave = 0; octave < 64; ++octave) {
    file << static_cast<int>(octave) - 60;
    for (std::size_t w = 0; w < ways; ++w) {
      long sum = 0;
      for (const auto& row : table) sum += row[w].octaves[octave];
      file << ',' << sum;
    }
    file << '\n';
  }
}

void report(const Table& table, const Coverage& coverage, double draws) {
  std::printf(
      "worst relative error, %.3g pixels: of the pixel's largest component; of each component's own "
      "terms\n%-20s",
      draws, "");
  for (int twice = 0; twice < 2; ++twice)
    for (const char* way : way_names) std::printf(" %10s", way);
  std::printf(" %10s\n", "over 1e-6");
  for (std::size_t r = 0; r < regime_count; ++r) {
    const auto& row = table[r];
    std::printf("%-20s %10.2e %10.2e %10.2e %10.2e %10.2e %10.2e %9.3f%% (%.2g)\n",
                name(static_cast<Regime>(r)), row[0].error, row[1].error, row[2].error, row[0].component,
                row[1].component, row[2].component,
                100 * static_cast<double>(coverage.lenient[r]) / static_cast<double>(coverage.drawn[r]),
                coverage.most[r]);
  }
  std::printf("within 8 ulp of");
  for (std::size_t t = 0; t < threshold_count; ++t)
    std::printf("%s %s: %ld", t == 0 ? "" : ",", name(static_cast<Threshold>(t)), coverage.at[t]);
  std::printf("\n");
  if (const char* path = std::getenv("SCOTOPIC_WORST")) {
    std::ofstream file(path);
    file << "# regime,way,planes (0 RGB, 1 with rods, 2 with cones),error,R,G,B,L,M,S,rod,setting\n";
    for (int r = 0; r < regime_count; ++r)
      for (std::size_t w = 0; w < ways; ++w)
        file << to_text(static_cast<Regime>(r), static_cast<Way>(w), table[static_cast<std::size_t>(r)][w])
             << '\n';
  }
  if (const char* path = std::getenv("SCOTOPIC_HISTOGRAM")) write_histogram(table, path);
}

TEST(Millions, every_regime_stays_within_its_bound_of_exact_arithmetic) {
  constexpr int each = 64;
  const double draws = from_environment("SCOTOPIC_DRAWS", 1e6);
  const auto settings = static_cast<int>(std::ceil(draws / (each * regime_count)));
  Random random(static_cast<std::uint64_t>(from_environment("SCOTOPIC_SEED", 1)));
  Table table;
  Failures failures;
  Coverage coverage;
  for (int s = 0; s < settings; ++s) judge_setting(random, each, table, failures, coverage);
  report(table, coverage, static_cast<double>(settings) * each * regime_count);
  EXPECT_EQ(failures.above_bound, 0) << failures.first;
  EXPECT_LE(static_cast<double>(failures.components_above_bound), 1e-6 * draws);
  EXPECT_EQ(failures.components_far_above, 0) << failures.first_component;
  EXPECT_EQ(failures.changed_untouched, 0);
  for (std::size_t r = 0; r < regime_count; ++r) {
    const auto regime = static_cast<Regime>(r);
    const auto drawn = static_cast<double>(coverage.drawn[r]);
    EXPECT_GE(drawn, draws / regime_count) << name(regime);
    EXPECT_LE(static_cast<double>(coverage.lenient[r]),
              (regime == Regime::kernel_clamp ? 0.05 : 1e-4) * drawn)
        << "pixels that may err by 1e-6 in double: " << name(regime);
  }
  for (std::size_t t = 0; t < threshold_count; ++t)
    EXPECT_GE(static_cast<double>(coverage.at[t]), 5e-3 * draws) << name(static_cast<Threshold>(t));
}

TEST(Millions, the_worst_pixels_ever_found_stay_within_their_bounds) {
  const auto kept = read_worst(WORST_CSV);
  ASSERT_GE(kept.size(), static_cast<std::size_t>(regime_count) * ways);
  for (const Kept& k : kept) {
    const Evaluators way(k.parameters);
    const auto pixel = k.sample.widened(k.planes);
    const Triple<Mp> expected = ExactOperator<Mp>(k.parameters)(pixel);
    Rows single({k.sample}), dual({k.sample});
    way.single.apply(single.view(k.planes));
    way.dual.apply(dual.view(k.planes));
    const auto widen = [](const std::array<float, 3>& v) { return Vec3<double>{v[0], v[1], v[2]}; };
    const std::array<Vec3<double>, ways> got = {way.reference(pixel), widen(single.rgb(0)),
                                                widen(dual.rgb(0))};
    const Strain strained = strain(way.reference.constants(), k.sample, k.planes);
    for (std::size_t w = 0; w < ways; ++w)
      EXPECT_LE(relative_error(got[w], expected, k.sample, k.planes, static_cast<Way>(w)),
                allowed_error(static_cast<Way>(w), k.parameters.rods, strained))
          << name(k.regime) << ", " << way_names[w] << ", found by "
          << way_names[static_cast<std::size_t>(k.way)];
  }
}

TEST(Millions, long_double_is_a_sound_judge_itself) {
  // The judge of millions against 256 bits, on a few thousand of them.
  Random random(2);
  double worst = 0;
  for (int s = 0; s < 40; ++s) {
    const AppearanceParameters p = draw_parameters(random);
    const Planes planes = draw_planes(random);
    const OperatorConstants constants(p);
    const ExactOperator<Mp> exact(p);
    const ExactOperator<long double> judge(p);
    for (int regime = 0; regime < regime_count; ++regime)
      for (int k = 0; k < 4; ++k) {
        const Sample sample = draw(static_cast<Regime>(regime), constants, random);
        const Strain strained = strain(constants, sample, planes);
        if (strained.cancelled || strained.root > 100) continue;
        const Triple<Mp> expected = exact(sample.widened(planes));
        const Triple<long double> got = judge(sample.widened(planes));
        long double size = std::max(0x1p-1000, size_in(sample, planes)), error = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          // A long double in two doubles.
          const auto high = static_cast<double>(got[i]);
          const Mp gap = expected[i] - Mp(high) - Mp(static_cast<double>(got[i] - high));
          size = std::max(size, std::abs(got[i]));
          error = std::max(error, std::abs(static_cast<long double>(static_cast<double>(gap))));
        }
        worst = std::max(worst, static_cast<double>(error / size));
      }
  }
  std::printf("long double against 256 bits: worst relative error %.2e\n", worst);
  EXPECT_LE(worst, 1e-17);
}

}  // namespace
}  // namespace scotopic::test

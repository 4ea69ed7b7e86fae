// What must not matter to the batch: order, grouping, threads, layout and the machine's vector instructions.
#include <hwy/targets.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <set>
#include <string>
#include <thread>

#include "properties/judge.h"
#include "properties/pixels.h"
#include "properties/property.h"
#include "support/primaries.h"

namespace scotopic::test {
namespace {

// A hundred pixels of all regimes under one setting.
struct Row {
  AppearanceParameters parameters;
  Planes planes;
  std::vector<Sample> samples;
};

Row draw_row(std::uint64_t seed, Coverage& coverage, int pixels) {
  Random random(seed);
  Row row{draw_parameters(random), draw_planes(random), {}};
  const OperatorConstants constants(row.parameters);
  for (int i = 0; i < pixels; ++i) {
    const auto regime = static_cast<Regime>(random.below(regime_count));
    coverage(name(regime));
    row.samples.push_back(draw(regime, constants, random));
  }
  return row;
}

std::vector<std::array<std::uint32_t, 3>> row_bits(Rows& rows) {
  std::vector<std::array<std::uint32_t, 3>> out;
  for (std::size_t i = 0; i < rows.r.size(); ++i) out.push_back(bits(rows.rgb(i)));
  return out;
}

// A row of 37 pixels holds a given one of 20 regimes in 85 % of draws.
const Shares regimes_in_rows = all_regimes({}, {}, 0.8);

TEST(BatchProperties, order_and_grouping_of_pixels_do_not_matter) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        const Row row = draw_row(seed, coverage, 70);
        Random random(seed + 1);
        const Precision precision = random.chance(0.5) ? Precision::single : Precision::dual;
        const AppearanceBatch batch(row.parameters, precision);
        Rows whole(row.samples);
        batch.apply(whole.view(row.planes));
        const auto expected = row_bits(whole);
        std::vector<Sample> shuffled;
        std::vector<std::size_t> from(row.samples.size());
        for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
        for (std::size_t i = from.size() - 1; i > 0; --i) std::swap(from[i], from[random.bits() % (i + 1)]);
        for (const std::size_t i : from) shuffled.push_back(row.samples[i]);
        Rows parts(shuffled);
        for (std::size_t at = 0; at < shuffled.size();) {
          PixelRows view = parts.view(row.planes);
          const std::size_t count = std::min<std::size_t>(1 + random.bits() % 40, shuffled.size() - at);
          for (float** plane : {&view.r, &view.g, &view.b}) *plane += at;
          for (const float** plane : {&view.cone_l, &view.cone_m, &view.cone_s, &view.rod})
            if (*plane) *plane += at;
          view.count = count;
          batch.apply(view);
          at += count;
        }
        const auto got = row_bits(parts);
        for (std::size_t i = 0; i < from.size(); ++i) RC_ASSERT(got[i] == expected[from[i]]);
      },
      regimes_in_rows);
}

TEST(BatchProperties, every_simd_target_gives_the_same_bits) {
  constexpr bool compiled_for_one = (HWY_TARGETS & (HWY_TARGETS - 1)) == 0;
  const auto targets = hwy::SupportedAndGeneratedTargets();
  if (compiled_for_one || targets.size() == 1)
    GTEST_SKIP() << (compiled_for_one ? "compiled for one target"
                                      : "this machine has but one of the targets");
  std::set<std::string> compared;
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        const Row row = draw_row(seed, coverage, 37);
        const Precision precision = seed % 2 ? Precision::single : Precision::dual;
        const AppearanceBatch batch(row.parameters, precision);
        std::vector<std::array<std::uint32_t, 3>> expected;
        for (const int64_t target : targets) {
          hwy::SetSupportedTargetsForTest(target);
          Rows rows(row.samples);
          batch.apply(rows.view(row.planes));
          if (std::strcmp(simd_target(), "Unknown") != 0)
            compared.insert(simd_target());  // the library may have fewer
          const auto got = row_bits(rows);
          if (expected.empty()) expected = got;
          if (got != expected) hwy::SetSupportedTargetsForTest(0);
          RC_ASSERT(got == expected);
        }
        hwy::SetSupportedTargetsForTest(0);
      },
      regimes_in_rows);
  EXPECT_GE(compared.size(), 2u) << "the library ran one target only";
  for (const auto& target : compared) std::printf("compared: %s\n", target.c_str());
}

TEST(BatchProperties, threads_do_not_matter) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        const Row row = draw_row(seed, coverage, 2 * 34);
        const AppearanceBatch batch(row.parameters);
        Rows one(row.samples), many(row.samples);
        batch.apply(one.view(row.planes));
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < 2; ++t)
          threads.emplace_back([&, t] {
            PixelRows view = many.view(row.planes);
            for (float** plane : {&view.r, &view.g, &view.b}) *plane += 34 * t;
            for (const float** plane : {&view.cone_l, &view.cone_m, &view.cone_s, &view.rod})
              if (*plane) *plane += 34 * t;
            view.count = 34;
            batch.apply(view);
          });
        for (auto& thread : threads) thread.join();
        RC_ASSERT(row_bits(many) == row_bits(one));
      },
      regimes_in_rows);
}

TEST(BatchProperties, pixels_side_by_side_give_what_planes_give_and_alpha_keeps_its_bits) {
  for_all(
      seeds(),
      [](std::uint64_t seed, Coverage& coverage) {
        Row row = draw_row(seed, coverage, 37);
        row.planes = Planes::rgb;
        const AppearanceBatch batch(row.parameters, seed % 2 ? Precision::single : Precision::dual);
        Random random(seed + 1);
        std::vector<float> rgba;
        std::vector<std::uint32_t> alpha;
        for (const Sample& sample : row.samples) {
          alpha.push_back(
              static_cast<std::uint32_t>(random.bits()));  // any bits: NaNs of every payload among them
          rgba.insert(rgba.end(), sample.rgb.begin(), sample.rgb.end());
          rgba.push_back(std::bit_cast<float>(alpha.back()));
          coverage("alpha is NaN", std::isnan(rgba.back()));
        }
        batch.apply_rgba(rgba.data(), row.samples.size());
        Rows planes(row.samples);
        batch.apply(planes.view(row.planes));
        const auto expected = row_bits(planes);
        for (std::size_t i = 0; i < row.samples.size(); ++i) {
          RC_ASSERT(std::memcmp(&rgba[4 * i], expected[i].data(), sizeof expected[i]) == 0);
          RC_ASSERT(std::memcmp(&rgba[4 * i + 3], &alpha[i], sizeof alpha[i]) == 0);
        }
      },
      all_regimes({}, {{"alpha is NaN", 0.1}}, 0.8));
}

TEST(BatchProperties, where_two_faces_of_the_gamut_meet_no_result_slips_out) {
  // Between two pixels that end on different faces, halving finds the two floats where one face takes over;
  // there both faces' solutions are the same to rounding, and rounding must not decide for a negative
  // component.
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            AppearanceParameters p;
            p.model = random.chance(0.5) ? Model::kirk2011 : Model::filament2021;
            p.adaptation = random.log_uniform(1e-4, 1e-2);
            p.white_luminance = p.adaptation;
            p.luminance = LuminancePolicy::none;
            p.strength.chroma = 0;
            p.xyz_from_rgb = p.xyz_from_gamut.emplace(rec709);
            const bool single = random.chance(0.7);
            const AppearanceBatch batch(p, single ? Precision::single : Precision::dual);
            Sample ends[2];
            for (Sample& end : ends) {
              for (auto& x : end.rgb) x = static_cast<float>(random.log_uniform(1e-4, 1));
              for (auto& x : end.cones)
                x = static_cast<float>(random.log_uniform(1e-3, 1e6));  // gains of any ratio
              end.rod = static_cast<float>(random.log_uniform(1, 1e4));
            }
            const auto at = [&](float t) {
              Sample s = ends[0];
              for (std::size_t i = 0; i < 3; ++i) {
                s.rgb[i] += t * (ends[1].rgb[i] - ends[0].rgb[i]);
                s.cones[i] += t * (ends[1].cones[i] - ends[0].cones[i]);
              }
              s.rod += t * (ends[1].rod - ends[0].rod);
              Rows rows({s});
              batch.apply(rows.view(Planes::all));
              for (const float x : rows.rgb(0)) RC_ASSERT(x >= 0);
              return rows.rgb(0);
            };
            const auto faces = [](const Rgb& v) { return (v[0] == 0) + 2 * (v[1] == 0) + 4 * (v[2] == 0); };
            float low = 0, high = 1;
            const int first = faces(at(low)), last = faces(at(high));
            // From inside to a face there is nothing to choose: the sign of a component decides.
            const bool between_faces = first != last && first && last;
            RC_PRE(between_faces);
            coverage("single", single);
            coverage("dual", !single);
            while (std::nextafter(low, high) < high) {
              const float middle = low + (high - low) / 2;
              if (middle == low || middle == high) break;
              (faces(at(middle)) == first ? low : high) = middle;
            }
          },
          {{"single", 0.5}, {"dual", 0.2}});
}

TEST(BatchProperties, a_strength_too_small_for_the_number_type_changes_no_bit) {
  for_all(
      cases({Regime::huge}),
      [](Case c, Coverage& coverage) {
        if (c.parameters.model == Model::safko2019) c.parameters.model = Model::filament2021;
        c.parameters.strength.chroma = 0;
        Case least = c;
        least.parameters.strength.chroma = 0x1p-55;
        coverage(name(c.regime));
        for (const Precision precision : {Precision::single, Precision::dual})
          RC_ASSERT(bits(applied(AppearanceBatch(least.parameters, precision), least)) ==
                    bits(applied(AppearanceBatch(c.parameters, precision), c)));
      },
      all_regimes({Regime::huge}));
}

}  // namespace
}  // namespace scotopic::test

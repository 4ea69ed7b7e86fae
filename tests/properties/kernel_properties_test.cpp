// What holds for the kernel, the adaptation formulas and the projection, whatever they are given.
#include <algorithm>
#include <cmath>
#include <limits>

#include "adaptation/mesopic.h"
#include "adaptation/pupil.h"
#include "stages/shared/projection.h"
#include "stages/reference.h"
#include "kernel/kernel.h"
#include "properties/pixels.h"
#include "properties/property.h"
#include "receptors/receptor_space.h"

namespace scotopic::test {
namespace {

struct Signals {
  Model model;
  double scale;
  Vec3<double> q;
  double r;
};

Signals draw_signals(Random& random, double least = 1e-12, double greatest = 1e12, bool positive = false) {
  Signals s;
  s.model = random.chance(0.5) ? Model::filament2021 : Model::kirk2011;
  s.scale = random.log_uniform(1e-2, 1e5);
  for (auto& x : s.q) x = (positive ? 1 : random.sign()) * random.log_uniform(least, greatest);
  s.r = (positive || random.chance(0.8) ? 1 : -1) * random.log_uniform(least, greatest);
  if (random.chance(0.05)) s.r = 0;
  return s;
}

Kernel<double> kernel_of(const Signals& s) { return Kernel<double>(kernel_preset(s.model), s.scale); }

Vec3<double> grey(double y) { return {0.538679 * y, 0.461321 * y, 0.295870 * y}; }

double length(const Vec3<double>& v) { return std::sqrt(dot(v, v)); }

Vec3<double> minus(const Vec3<double>& a, const Vec3<double>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

TEST(KernelProperties, no_rods_no_shift) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            Signals s = draw_signals(random);
            s.r = -std::abs(s.r);
            coverage("zero", s.r == 0);
            coverage("negative cone", s.q[0] < 0);
            RC_ASSERT(kernel_of(s).shift(s.q, s.r) == (Vec3<double>{0, 0, 0}));
          },
          {{"zero", 0.03}, {"negative cone", 0.3}});
}

TEST(KernelProperties, gains_lie_in_0_to_1_and_fall_as_cones_or_rods_rise) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const Signals s = draw_signals(random, 1e-30, 1e30);
            const auto kernel = kernel_of(s);
            const auto g = kernel.gains(s.q, s.r);
            Vec3<double> brighter = s.q;
            for (auto& x : brighter) x += std::abs(x) * random.uniform(0, 2);
            const auto with_brighter = kernel.gains(brighter, s.r),
                       with_rods = kernel.gains(s.q, std::abs(s.r) * 2);
            for (std::size_t i = 0; i < 3; ++i) {
              coverage("clamped", g[i] == 1);
              coverage("deeply adapted", g[i] < 1e-3);
              RC_ASSERT(g[i] > 0 && g[i] <= 1);
              RC_ASSERT(with_brighter[i] <= g[i]);
              RC_ASSERT(with_rods[i] <= g[i]);
            }
          },
          {{"clamped", 0.3}, {"deeply adapted", 0.3}});
}

TEST(KernelProperties, the_scale_is_a_unit_and_nothing_else) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const Signals s = draw_signals(random);
            const double unit = std::exp2(random.below(41) - 20);  // exact: any digit lost is the kernel's
            Signals scaled = s;
            scaled.scale = s.scale / unit;
            const auto a = kernel_of(s).shift(s.q, s.r);
            const auto b = kernel_of(scaled).shift({s.q[0] * unit, s.q[1] * unit, s.q[2] * unit}, s.r * unit);
            coverage("rods", s.r > 0);
            for (std::size_t i = 0; i < 3; ++i) RC_ASSERT(b[i] == a[i] * unit);
          },
          {{"rods", 0.5}});
}

TEST(KernelProperties, the_scotopic_limit_is_a_3x3_matrix) {
  // g -> 1: shift -> A^-1 N (r, r, r). Kernel units of 1e-6 keep the gains within 3e-7 of 1.
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            Signals s = draw_signals(random, 1e-9, 1e-6, true);
            s.scale = s.model == Model::kirk2011 ? 40 : 1;
            const auto kernel = kernel_of(s);
            const auto shift = kernel.shift(s.q, s.r);
            const auto limit = kernel.cone_shift() * Vec3<double>{s.r, s.r, s.r};
            coverage("kirk2011", s.model == Model::kirk2011);
            for (std::size_t i = 0; i < 3; ++i)
              RC_ASSERT(std::abs(shift[i] - limit[i]) <= 1e-4 * length(limit));
            if (s.scale * std::max({s.q[0], s.q[1], s.q[2], s.r}) < 2e-5)
              for (std::size_t i = 0; i < 3; ++i)
                RC_ASSERT(std::abs(shift[i] - limit[i]) <= 1e-5 * length(limit));
          },
          {{"kirk2011", 0.3}});
}

TEST(KernelProperties, a_bright_grey_shifts_by_17_748_over_the_root_of_its_trolands) {
  const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
  for_all(seeds(),
          [&](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const double td = random.log_uniform(1e6, 1e14);
            const double relative = length(kernel.shift(grey(td), 0.498568 * td)) / length(grey(td));
            coverage("a million trolands", td < 1e7);
            RC_ASSERT(std::abs(relative * std::sqrt(td) / 17.7485 - 1) <= 3e-5);
          },
          {{"a million trolands", 0.05}});
}

TEST(KernelProperties, is_continuous_with_a_stated_slope_across_the_clamp_too) {
  // Each g r moves by at most |dr| + .1925/kappa |dq| for cones that see light: .1925 is the maximum of
  // x/2 (1 + x)^-3/2. Where rods cancel a negative cone under the root, by 1 + G kappa r/2 and G r/2, G =
  // gain T.
  double steepest = 0;
  for_all(seeds(),
          [&](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            Signals a = draw_signals(random, 1e-9, 1e9, true);
            const auto kernel = kernel_of(a);
            const bool light = random.chance(0.5);
            if (!light)
              for (std::size_t i = 0; i < 3; ++i)
                a.q[i] = -kernel.kappa()[i] * a.r * (1 + random.sign() * random.log_uniform(1e-9, 1));
            Signals b = a;
            const double step = random.log_uniform(1e-9, 1);
            for (auto& x : b.q) x += step * random.uniform(-1, 1) * (light ? x : a.r);
            b.r *= 1 + step * random.uniform(-1, 1);
            const double more_rods = std::max(a.r, b.r), rods_moved = std::abs(a.r - b.r);
            Vec3<double> bound;
            bool crossed = false;
            for (std::size_t j = 0; j < 3; ++j) {
              const double kappa = kernel.kappa()[j], root = 0.5 * kernel.gain()[j] * more_rods,
                           moved = std::abs(a.q[j] - b.q[j]);
              bound[j] = light ? rods_moved + 0.1925 / kappa * moved
                               : (1 + kappa * root) * rods_moved + root * moved;
              crossed = crossed || (a.q[j] + kappa * a.r < 0) != (b.q[j] + kappa * b.r < 0);
            }
            coverage("light", light);
            coverage("crossing the clamp", crossed);
            const auto from = kernel.shift(a.q, a.r), to = kernel.shift(b.q, b.r);
            for (std::size_t i = 0; i < 3; ++i) {
              double most = 0, terms = 0;
              for (std::size_t j = 0; j < 3; ++j) {
                most += std::abs(kernel.cone_shift()[i][j]) * bound[j];
                terms += std::abs(kernel.cone_shift()[i][j]) * more_rods;
              }
              // Rounding of the sum under the root, which a cancellation makes larger than its result.
              const double rounding =
                  1e-15 * terms *
                  (light ? 4 : 1 + kernel.gain()[0] * more_rods + kernel.gain()[2] * more_rods);
              RC_ASSERT(std::abs(to[i] - from[i]) <= most * (1 + 1e-9) + rounding);
              if (light) steepest = std::max(steepest, std::abs(to[i] - from[i]) / most);
            }
          },
          {{"light", 0.4}, {"crossing the clamp", 0.1}});
  std::printf("steepest: %.2f of the bound for light\n", steepest);
  EXPECT_GT(steepest, 0.5) << "the bound says too little";
}

TEST(KernelProperties, rods_add_luminance_and_more_rods_add_more) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const Signals s = draw_signals(random, 1e-9, 1e9, true);
            const auto kernel = kernel_of(s);
            const auto luminance = [&](double r) {
              const auto d = kernel.shift(s.q, r);
              return d[0] + d[1];
            };
            const double more = s.r * random.uniform(1.001, 100);
            coverage("twice and more", more > 2 * s.r);
            RC_ASSERT(luminance(s.r) >= 0);
            RC_ASSERT(luminance(more) >= luminance(s.r));
          },
          {{"twice and more", 0.5}});
}

TEST(KernelProperties, the_shift_of_a_grey_turns_by_15_4_degrees_from_dark_to_bright_by_5_3_under_kirk2011) {
  // Opponent angles, red-green against blue-yellow; more light turns them one way only.
  constexpr double from[] = {52.6, -7.2}, to[] = {68.0, -1.8};
  double least[] = {360, 360}, most[] = {-360, -360};
  for_all(seeds(),
          [&](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const bool kirk = random.chance(0.5);
            const Kernel<double> kernel(kernel_preset(kirk ? Model::kirk2011 : Model::filament2021), 1.0);
            const auto angle = [&](double y) {
              const auto o = opponent_from_lms * kernel.shift(grey(y), 0.498568 * y);
              return std::atan2(o[1], o[0]) * 57.29577951308232;
            };
            const double y = random.log_uniform(1e-9, 1e9), here = angle(y),
                         above = angle(y * random.uniform(1, 10));
            coverage("kirk2011", kirk);
            coverage("filament2021", !kirk);
            least[kirk] = std::min(least[kirk], here);
            most[kirk] = std::max(most[kirk], here);
            RC_ASSERT(here >= from[kirk] && here <= to[kirk]);
            RC_ASSERT(above >= here - 1e-9);
          },
          {{"filament2021", 0.4}, {"kirk2011", 0.4}});
  std::printf("hue of a grey's shift: filament2021 %.2f to %.2f, kirk2011 %.2f to %.2f degrees\n", least[0],
              most[0], least[1], most[1]);
}

TEST(AdaptationProperties, the_mesopic_coefficient_is_the_fixed_point_of_mes2) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const double l = random.log_uniform(1e-12, 1e6), sp = random.log_uniform(0.05, 8);
            const double m = mesopic_coefficient(l, sp), c = mes2_efficacy_ratio;
            RC_ASSERT(m >= 0 && m <= 1);
            const double mes = (m * l + (1 - m) * sp * l * c) / (m + (1 - m) * c);
            const double again = std::clamp(mes2_offset + mes2_slope * std::log10(mes), 0.0, 1.0);
            coverage("mesopic", m > 0 && m < 1);
            coverage("scotopic", m == 0);
            coverage("photopic", m == 1);
            RC_ASSERT(std::abs(again - m) <= 1e-14);
            const double brighter = l * random.uniform(1, 2);
            RC_ASSERT(mesopic_coefficient(brighter, sp) >= m);
            // The plain iteration converges for lights of S/P .25 to 4; beyond, it may swing.
            if (sp >= 0.25 && sp <= 4) {
              coverage("a lamp's S/P");
              RC_ASSERT(std::abs(mesopic_state(l, sp * l).adaptation_coefficient - m) <= 1e-13);
            }
          },
          {{"mesopic", 0.1}, {"scotopic", 0.2}, {"photopic", 0.2}, {"a lamp's S/P", 0.3}});
}

TEST(AdaptationProperties, mes2_starts_from_a_half_where_that_decides) {
  // At S/P .05 and .1 cd/m2 there are two fixed points; CIE 191 starts from m = .5, which leads to the upper.
  EXPECT_NEAR(mesopic_state(0.1, 0.005).adaptation_coefficient, 0.3608, 1e-4);
  EXPECT_EQ(mesopic_coefficient(0.1, 0.05), 0);
}

TEST(AdaptationProperties, mes2_is_a_number_at_every_pair_of_luminances_even_0) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const auto luminance = [&] {
              return random.chance(0.2) ? 0.0 : random.log_uniform(1e-200, 1e30);
            };
            const double p = luminance(), s = luminance();
            const MesopicState state = mesopic_state(p, s);
            coverage("both 0", p == 0 && s == 0);
            coverage("rods alone", p == 0 && s > 0);
            coverage("extreme ratio", s > 1e10 * p);
            RC_ASSERT(state.adaptation_coefficient >= 0 && state.adaptation_coefficient <= 1);
            RC_ASSERT(state.luminance >= 0 && state.luminance <= std::max(p, s) * (1 + 1e-12));
            if (p == 0 && s == 0) RC_ASSERT(state.adaptation_coefficient == 0);
          },
          {{"both 0", 0.02}, {"rods alone", 0.1}, {"extreme ratio", 0.1}});
}

TEST(AdaptationProperties, the_pupil_narrows_with_light_between_2_and_8_mm) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const double la = random.chance(0.01) ? 0 : random.log_uniform(1e-12, 1e12),
                         more = la * random.uniform(1, 3);
            const double d = pupil_diameter_mm(la);
            coverage("dark", la < 1e-3);
            coverage("0", la == 0);
            RC_ASSERT(d >= 2 && d <= 8);
            RC_ASSERT(pupil_diameter_mm(more) <= d);
            RC_ASSERT(std::abs(trolands_per_luminance(la) - 0.7853981633974483 * d * d) <= 1e-14 * d * d);
          },
          {{"dark", 0.2}, {"0", 0.005}});
}

class ProjectionProperties : public testing::Test {
 protected:
  struct Gamut {
    Matrix3<double> lms;
    GamutProjection<double> projection;

    Vec3<double> nearest(const Vec3<double>& z) const { return projection.nearest(z); }
    double distance(const Vec3<double>& a, const Vec3<double>& b) const { return length(lms * minus(a, b)); }
  };

  Gamut any_gamut(Random& random, Coverage& coverage) const {
    const WorkingSpace& space = any_space(random);
    coverage(space.name);
    const Matrix3<double> lms = lms_from_xyz() * space.xyz_from_rgb;
    return {lms, GamutProjection<double>(lms)};
  }

  Vec3<double> draw(Random& random) const {
    const double size = random.log_uniform(1e-20, 1e20);
    Vec3<double> z;
    for (auto& x : z)
      x = size * (random.chance(0.1) ? 0 : random.uniform(-1, 1)) * random.log_uniform(1e-3, 1);
    return z;
  }
};

TEST_F(ProjectionProperties, never_leaves_the_gamut_and_rests_inside) {
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        const Gamut gamut = any_gamut(random, coverage);
        const auto z = draw(random), p = gamut.nearest(z);
        const bool inside = z[0] >= 0 && z[1] >= 0 && z[2] >= 0;
        coverage("inside", inside);
        for (std::size_t free = 0; free < 4; ++free)
          coverage("faces " + std::to_string(free),
                   !inside && static_cast<std::size_t>((p[0] > 0) + (p[1] > 0) + (p[2] > 0)) == free);
        RC_ASSERT(p[0] >= 0 && p[1] >= 0 && p[2] >= 0);
        if (inside) RC_ASSERT(p == z);
        RC_ASSERT(gamut.nearest(p) == p);
      },
      all_working_spaces({{"inside", 0.05}, {"faces 0", 0.05}, {"faces 1", 0.1}, {"faces 2", 0.1}}));
}

TEST_F(ProjectionProperties, no_colour_of_the_gamut_is_nearer) {
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        const Gamut gamut = any_gamut(random, coverage);
        const auto z = draw(random), p = gamut.nearest(z);
        Vec3<double> other = p;
        const double size = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
        for (auto& x : other) x = std::max(0.0, x + random.sign() * random.log_uniform(1e-8, 1) * size);
        coverage("outside", p != z);
        RC_ASSERT(gamut.distance(p, z) <= gamut.distance(other, z) * (1 + 1e-12) + 1e-14 * size);
      },
      all_working_spaces({{"outside", 0.5}}));
}

TEST_F(ProjectionProperties, finds_the_colour_that_a_point_was_made_from_even_where_sets_meet) {
  // z = x - G^-1 l with x, l >= 0 and x_i l_i = 0 has x for its nearest colour (Karush, Kuhn, Tucker). Where
  // both x_i and l_i are 0, two active sets tie to the last bit, and rounding may put the winner's component
  // below 0.
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        const Gamut gamut = any_gamut(random, coverage);
        Vec3<double> x{}, multiplier{};
        int ties = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const int kind = random.below(3);
          if (kind == 0) x[i] = random.log_uniform(1e-6, 1);
          if (kind == 1) multiplier[i] = random.log_uniform(1e-6, 1);
          ties += kind == 2;
        }
        const auto z = minus(x, inverse(transpose(gamut.lms) * gamut.lms) * multiplier);
        const auto p = gamut.nearest(z);
        coverage("a tie", ties > 0);
        coverage("a tie elsewhere than at black", ties > 0 && length(x) > 0 && length(multiplier) > 0);
        RC_ASSERT(p[0] >= 0 && p[1] >= 0 && p[2] >= 0);
        RC_ASSERT(length(minus(p, x)) <= 1e-10 * std::max(length(x), length(z)));
      },
      all_working_spaces({{"a tie", 0.5}, {"a tie elsewhere than at black", 0.2}}));
}

TEST_F(ProjectionProperties, never_expands_a_distance) {
  for_all(
      seeds(),
      [&](std::uint64_t seed, Coverage& coverage) {
        Random random(seed);
        const Gamut gamut = any_gamut(random, coverage);
        const auto a = draw(random);
        Vec3<double> b = draw(random);
        if (random.chance(0.5)) {
          const double step = random.log_uniform(1e-9, 1);
          for (std::size_t i = 0; i < 3; ++i) b[i] = a[i] * (1 + random.uniform(-1, 1) * step);
        }
        const double before = gamut.distance(a, b);
        coverage("near", before < 1e-3 * length(gamut.lms * a));
        const double rounding = 1e-14 * std::max(length(gamut.lms * a), length(gamut.lms * b));
        RC_ASSERT(gamut.distance(gamut.nearest(a), gamut.nearest(b)) <= before * (1 + 1e-12) + rounding);
      },
      all_working_spaces({{"near", 0.2}}));
}

TEST(LuminanceRatioProperties, is_bounded_exact_on_light_and_continuous) {
  // Bounds of the contract; the slope in `from` is at most 2 (1 + |to|/f)/f: u/f and u^2 each give one. f is
  // least where a step comes nearest to 0.
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const double largest = random.log_uniform(1e-12, 1e12), floor = luminance_floor * largest;
            const double from = random.sign() * largest * random.log_uniform(1e-6, 1);
            const double to = random.sign() * largest * random.log_uniform(1e-6, 10);
            const double ratio = luminance_ratio(from, to, largest);
            coverage("regularised", std::abs(from) < floor);
            coverage("negative", from < 0 && to < 0);
            RC_ASSERT(ratio >= 0 && ratio <= std::abs(to) / floor + 1);
            if (std::abs(from) >= floor && from * to > 0)
              RC_ASSERT(std::abs(ratio - to / from) <= 1e-14 * ratio);
            RC_ASSERT(luminance_ratio(from, from, largest) == 1);
            const double step = random.sign() * random.log_uniform(1e-12, 10) * std::abs(from),
                         next = from + step;
            const bool crosses = from * next < 0;
            coverage("crosses 0", crosses);
            coverage("crosses 0 from a light", crosses && std::abs(from) >= floor);
            const double f = std::max(crosses ? 0 : std::min(std::abs(from), std::abs(next)), floor);
            const double slope = 2 * (1 + std::abs(to) / f) / f;
            RC_ASSERT(std::abs(luminance_ratio(next, to, largest) - ratio) <=
                      slope * std::abs(step) + 1e-13 * (1 + std::abs(to) / f));
          },
          {{"regularised", 0.3}, {"negative", 0.1}, {"crosses 0", 0.02}, {"crosses 0 from a light", 0.005}});
}

TEST(RodEstimateProperties, is_homogeneous_floored_and_exact_at_white) {
  for_all(seeds(),
          [](std::uint64_t seed, Coverage& coverage) {
            Random random(seed);
            const auto kind = random.chance(0.5) ? RodEstimate::linear : RodEstimate::quadratic;
            Vec3<double> xyz;
            for (auto& x : xyz) x = random.sign() * random.log_uniform(1e-6, 1e6);
            const double s = scotopic_luminance_from_xyz(xyz, kind, sp_ratio_d65),
                         k = std::exp2(random.below(21) - 10);
            coverage("floored", s == sp_ratio_floor * xyz[1]);
            coverage("quadratic", kind == RodEstimate::quadratic);
            RC_ASSERT(s >= sp_ratio_floor * xyz[1]);
            RC_ASSERT(scotopic_luminance_from_xyz<double>({k * xyz[0], k * xyz[1], k * xyz[2]}, kind,
                                                          sp_ratio_d65) == k * s);
            const double y = std::abs(xyz[1]);
            const Vec3<double> white = {0.95047 * y, y, 1.08883 * y};
            RC_ASSERT(std::abs(scotopic_luminance_from_xyz(white, kind, sp_ratio_d65) / (sp_ratio_d65 * y) -
                               1) <= 1e-4);
          },
          {{"floored", 0.1}, {"quadratic", 0.4}});
}

}  // namespace
}  // namespace scotopic::test

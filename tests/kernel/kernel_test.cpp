// The kernel against published numbers. Tables: double precision, 17 digits, worked out outside this project.
#include "kernel/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>

#include "support/csv.h"

namespace scotopic {
namespace {

struct Worst {
  double error = 0;
  std::string where = "nowhere";
  void add(double got, double expected, const std::string& name) {
    const double e =
        std::abs(got - expected) / std::max(std::abs(expected), std::numeric_limits<double>::min());
    if (!(e <= error)) error = e, where = name;
  }
};

Vec3<double> plus(const Vec3<double>& a, const Vec3<double>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

TEST(Kernel, kirk2011_agrees_with_the_published_formula_to_1e_12) {
  const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
  Worst worst;
  int compared = 0;
  for (const auto& row : test::read_csv(KERNEL_VECTORS "/kirk2011_kernel.csv")) {
    const Vec3<double> q = {row["L"], row["M"], row["S"]};
    // The formula as printed knows neither clamp; what these do is tested below.
    if (row["R"] < 0 || q[0] + 0.25 * row["R"] < 0) continue;
    const Vec3<double> g = kernel.gains(q, row["R"]);
    const Vec3<double> shift = kernel.shift(q, row["R"]);
    const Vec3<double> opponent = opponent_from_lms * shift;
    const Vec3<double> out = plus(q, shift);
    worst.add(g[0], row["gL"], row.name + " gL");
    worst.add(g[1], row["gM"], row.name + " gM");
    worst.add(g[2], row["gS"], row.name + " gS");
    // Opponent signals are differences of shifts: relative to the largest of them.
    const double size = std::max({std::abs(row["dRG"]), std::abs(row["dBY"]), std::abs(row["dLum"]), 1e-300});
    worst.add(size + opponent[0] - row["dRG"], size, row.name + " dRG");
    worst.add(size + opponent[1] - row["dBY"], size, row.name + " dBY");
    worst.add(size + opponent[2] - row["dLum"], size, row.name + " dLum");
    worst.add(out[0], row["Lo"], row.name + " Lo");
    worst.add(out[1], row["Mo"], row.name + " Mo");
    worst.add(out[2], row["So"], row.name + " So");
    ++compared;
  }
  std::printf("kirk2011: %d rows, worst relative error %.3g at %s\n", compared, worst.error,
              worst.where.c_str());
  EXPECT_EQ(compared, 18);
  EXPECT_LE(worst.error, 1e-12);
}

TEST(Kernel, filament2021_agrees_with_the_public_function_to_1e_12) {
  // google/filament, ColorGrading.cpp: its LMSR signals are linear RGB through this matrix, times 380.
  constexpr Matrix3<double> lms_from_rgb{
      {{{7.696847, 18.424824, 2.068096}, {2.431137, 18.697937, 3.012463}, {0.289117, 1.401833, 13.792292}}}};
  constexpr Vec3<double> rod_from_rgb = {0.466386, 15.564362, 10.059963};
  constexpr double log_exposure = 380;
  const Kernel<double> kernel(kernel_preset(Model::filament2021), 1.0);
  Worst worst;
  int compared = 0;
  for (const auto& row : test::read_csv(KERNEL_VECTORS "/filament2021.csv")) {
    if (row["R"] < 0) continue;  // the public function lets negative rods act; here they count as none
    const Vec3<double> rgb = {row["r"], row["g"], row["b"]};
    Vec3<double> q = lms_from_rgb * rgb;
    for (double& x : q) x *= log_exposure;
    const double r = dot(rod_from_rgb, rgb) * log_exposure;
    const Vec3<double> out = plus(q, kernel.shift(q, r));
    worst.add(out[0], row["Lh"], row.name + " L");
    worst.add(out[1], row["Mh"], row.name + " M");
    worst.add(out[2], row["Sh"], row.name + " S");
    const Vec3<double> shifted = (1 / log_exposure) * inverse(lms_from_rgb) * out;
    const double size = std::max({std::abs(row["ro"]), std::abs(row["go"]), std::abs(row["bo"]), 1e-300});
    worst.add(size + shifted[0] - row["ro"], size, row.name + " red");
    worst.add(size + shifted[1] - row["go"], size, row.name + " green");
    worst.add(size + shifted[2] - row["bo"], size, row.name + " blue");
    ++compared;
  }
  std::printf("filament2021: %d rows, worst relative error %.3g at %s\n", compared, worst.error,
              worst.where.c_str());
  EXPECT_EQ(compared, 22);
  EXPECT_LE(worst.error, 1e-12);
}

TEST(Kernel, filament2021_counts_in_units_of_its_author_s_spot_meter) {
  // ColorGrading.cpp: 380, its logExposure, for an LMSR of 52.3313 per cd/m2.
  EXPECT_NEAR(filament2021_scale, 380 * 52.3313, 0.01);
}

TEST(Kernel, a_sum_below_the_root_s_domain_gives_gain_one_not_nan) {
  const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
  const Vec3<double> g = kernel.gains({-10, 1, 1}, 1);
  EXPECT_EQ(g[0], 1.0);
  EXPECT_NEAR(g[1], 0.84140632382334246, 1e-15);
  for (double x : kernel.shift({-10, 1, 1}, 1)) EXPECT_TRUE(std::isfinite(x));
}

TEST(Kernel, no_rod_signal_shifts_nothing) {
  for (const Model model : {Model::filament2021, Model::kirk2011})
    for (const double r : {0.0, -0.0, -0.01, -1e30}) {
      const Vec3<double> shift = Kernel<double>(kernel_preset(model), 20.0).shift({1, 2, -3}, r);
      EXPECT_EQ(shift, (Vec3<double>{0, 0, 0}));
    }
}

TEST(Kernel, scaling_signals_and_unscaling_the_kernel_changes_nothing_but_the_unit) {
  const Kernel<double> fine(kernel_preset(Model::filament2021), 1000.0);
  const Kernel<double> coarse(kernel_preset(Model::filament2021), 1.0);
  const Vec3<double> a = fine.shift({0.5, 0.4, 0.3}, 0.5);
  const Vec3<double> b = coarse.shift({500, 400, 300}, 500);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i] / 1000, 1e-13 * std::abs(a[i]));
}

TEST(Kernel, relative_shift_of_kirk2011_falls_with_the_root_of_the_light) {
  // |Δq|/|q| sqrt(td) tends to 17.748 for a D65 grey: half a percent of the effect is left at 1e7 trolands.
  const Kernel<double> kernel(kernel_preset(Model::kirk2011), 1.0);
  const double td = 1e6;
  const Vec3<double> q = {0.53867885654062808 * td, 0.46132114345937181 * td, 0.29586960034475729 * td};
  const Vec3<double> shift = kernel.shift(q, 0.49856795083875605 * td);
  const double relative = std::sqrt(dot(shift, shift) / dot(q, q));
  EXPECT_NEAR(relative * std::sqrt(td), 17.748, 1e-3);
}

TEST(Kernel, float_agrees_with_double_to_a_few_ulp) {
  const Kernel<double> reference(kernel_preset(Model::filament2021), filament2021_scale);
  const Kernel<float> kernel(kernel_preset(Model::filament2021), filament2021_scale);
  double worst = 0;
  for (int e = -60; e <= 60; ++e) {
    const double s = std::exp2(e / 2.0);
    const Vec3<double> q = {0.54 * s, 0.46 * s, 0.3 * s};
    const Vec3<double> exact = reference.shift(q, 0.5 * s);
    const Vec3<float> got = kernel.shift({float(q[0]), float(q[1]), float(q[2])}, float(0.5 * s));
    const double size = std::max({std::abs(exact[0]), std::abs(exact[1]), std::abs(exact[2])});
    for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(double(got[i]) - exact[i]) / size);
  }
  std::printf("float kernel: worst %.3g of the largest shift\n", worst);
  EXPECT_LE(worst, 5e-7);
}

}  // namespace
}  // namespace scotopic

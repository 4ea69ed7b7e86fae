#include "receptors/spectrum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "receptors/support.h"
#include "receptors/tables.h"

namespace scotopic {
namespace {

constexpr std::array<double, 3> three = {1.0, 3.0, 2.0};
constexpr TabulatedCurve curve{500.0, 10.0, three};

TEST(TabulatedCurve, is_linear_between_samples_and_zero_outside) {
  struct Row {
    double nm, expected;
  };
  for (const Row& row :
       {Row{500, 1}, Row{505, 2}, Row{510, 3}, Row{517.5, 2.25}, Row{520, 2}, Row{499.999, 0},
        Row{520.001, 0}, Row{-500, 0}, Row{1e300, 0}, Row{std::numeric_limits<double>::quiet_NaN(), 0}})
    EXPECT_DOUBLE_EQ(curve.at(row.nm), row.expected) << row.nm << " nm";
  EXPECT_EQ(curve.last_nm(), 520.0);
}

TEST(Spectrum, integral_over_disjoint_ranges_is_zero) {
  const TabulatedCurve infrared{900.0, 1.0, three};
  EXPECT_EQ(integrate(infrared, tables::xyz_cie_1931_2deg_y), 0.0);
}

TEST(Spectrum, one_watt_at_the_peaks_gives_the_efficacies) {
  const std::array<double, 1> one = {1.0};
  // V is 1 at 555 nm; V' is tabulated as 1.000 only at 507 nm, between the 5 nm samples of this table.
  EXPECT_DOUBLE_EQ(photopic_luminance({555.0, 1.0, one}).cdm2, 683.002);
  EXPECT_NEAR(scotopic_luminance({507.0, 1.0, one}).cdm2, 1700.06, 1700.06 * 0.005);
  // Both efficacies fix the same thing, the candela: 683 lm/W at 540 THz (555.017 nm in air).
  EXPECT_NEAR(scotopic_luminance({555.0, 1.0, one}).cdm2, 683.0, 683.0 * 0.002);
}

TEST(Spectrum, sp_ratios_of_standard_illuminants_are_the_published_ones) {
  const std::vector<double> equal_energy(81, 1.0);
  const Spectrum d50 = cie_daylight(5003.0);
  struct Row {
    const char* name;
    TabulatedCurve spectrum;
    double expected;  // 5 nm sums over 380-780 nm
  };
  test::WorstError worst;
  for (const Row& row :
       {Row{"E", {380, 5, equal_energy}, 2.2612}, Row{"A", tables::illuminant_cie_a_a, 1.4123},
        Row{"D50", d50.curve(), 2.1599}, Row{"D65", tables::illuminant_cie_d65_d65, 2.4648}})
    worst.add(row.name, sp_ratio(row.spectrum), row.expected, 1e-3);
  worst.expect_within("S/P ratio");
}

TEST(Spectrum, sp_ratio_does_not_depend_on_scale) {
  std::vector<double> dim(tables::illuminant_cie_a_a.values.begin(), tables::illuminant_cie_a_a.values.end());
  for (double& value : dim) value *= 0x1p-40;
  EXPECT_EQ(sp_ratio({380, 5, dim}), sp_ratio(tables::illuminant_cie_a_a));
}

}  // namespace
}  // namespace scotopic

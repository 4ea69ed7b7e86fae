#include "receptors/receptor_space.h"

#include <gtest/gtest.h>

#include "receptors/support.h"
#include "receptors/tables.h"

namespace scotopic {
namespace {

std::string element(std::size_t row, std::size_t column) {
  std::string text = std::to_string(row);
  return text.append(",").append(std::to_string(column));
}

TEST(ReceptorSpace, d65_of_one_candela_has_the_reference_signals) {
  const TabulatedCurve& d65 = tables::illuminant_cie_d65_d65;
  const double scale = luminance_units_per_watt() / photopic_luminance(d65).cdm2;
  const double l = scale * integrate(d65, tables::cones_stockman_sharpe_2000_2deg_l);
  const double m = scale * integrate(d65, tables::cones_stockman_sharpe_2000_2deg_m);
  test::WorstError worst;
  worst.add("L", l, 0.538679, 5e-4);
  worst.add("M", m, 0.461321, 5e-4);
  worst.add("S", scale * integrate(d65, tables::cones_stockman_sharpe_2000_2deg_s), 0.295870, 5e-4);
  worst.add("rod", scale * integrate(d65, tables::scotopic_cie_1951_v_prime), 0.498568, 5e-4);
  worst.add("L + M", l + m, 1.0, 1e-15);
  worst.add("rod from scotopic luminance",
            rod_signal_per_scotopic_luminance() * scotopic_luminance(d65).cdm2 / photopic_luminance(d65).cdm2,
            0.498568, 5e-4);
  worst.expect_within("signals of D65");
}

TEST(ReceptorSpace, fit_of_cie_1931_is_the_reference_matrix) {
  const double expected[3][3] = {
      {1.81179, -1.30803, 0.36481}, {0.60480, 0.41727, -0.03938}, {-0.04974, 0.08113, 1.82141}};
  test::WorstError worst;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      worst.add(element(i, j), colour_matching_from_cones()[i][j], expected[i][j], 2e-3);
  worst.expect_within("colour matching from cones");
}

// What makes a fit a least-squares fit, whatever way it was computed: the residual is orthogonal to the
// cones.
TEST(ReceptorSpace, residual_of_the_fit_is_orthogonal_to_the_cones) {
  const TabulatedCurve* cones[3] = {&tables::cones_stockman_sharpe_2000_2deg_l,
                                    &tables::cones_stockman_sharpe_2000_2deg_m,
                                    &tables::cones_stockman_sharpe_2000_2deg_s};
  const TabulatedCurve* matching[3] = {&tables::xyz_cie_1931_2deg_x, &tables::xyz_cie_1931_2deg_y,
                                       &tables::xyz_cie_1931_2deg_z};
  const Matrix3<double>& fit = colour_matching_from_cones();
  test::WorstError worst;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      long double product = 0.0L;
      for (int nm = 390; nm <= 830; ++nm) {
        const double fitted =
            fit[i][0] * cones[0]->at(nm) + fit[i][1] * cones[1]->at(nm) + fit[i][2] * cones[2]->at(nm);
        product += static_cast<long double>(matching[i]->at(nm) - fitted) * cones[j]->at(nm);
      }
      worst.add(element(i, j), static_cast<double>(product), 0.0, 1e-12);
    }
  worst.expect_within("residual times cone");
}

TEST(ReceptorSpace, lms_and_xyz_are_inverse_to_1e_14) {
  const Matrix3<double> product = lms_from_xyz() * xyz_from_lms();
  const Matrix3<double> reverse = xyz_from_lms() * lms_from_xyz();
  test::WorstError worst;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      worst.add(element(i, j), product[i][j], i == j ? 1.0 : 0.0, 1e-14);
      worst.add("reverse " + element(i, j), reverse[i][j], i == j ? 1.0 : 0.0, 1e-14);
    }
  worst.expect_within("LMS -> XYZ -> LMS");
}

// The cones do not span CIE 1931: the white of the matrix is not quite the white of the spectrum.
TEST(ReceptorSpace, d65_through_the_matrix_misses_unit_luminance_by_six_thousandths) {
  const Vec3<double> q = lms_from_xyz() * Vec3<double>{0.95047, 1.0, 1.08883};
  EXPECT_NEAR(q[0] + q[1], 0.9939, 1e-4);
}

}  // namespace
}  // namespace scotopic

#include "receptors/receptor_space.h"

#include "receptors/tables.h"

namespace scotopic {
namespace {

Vec3<long double> cones_at(double nm) {
  return {tables::cones_stockman_sharpe_2000_2deg_l.at(nm), tables::cones_stockman_sharpe_2000_2deg_m.at(nm),
          tables::cones_stockman_sharpe_2000_2deg_s.at(nm)};
}

Vec3<long double> colour_matching_at(double nm) {
  return {tables::xyz_cie_1931_2deg_x.at(nm), tables::xyz_cie_1931_2deg_y.at(nm),
          tables::xyz_cie_1931_2deg_z.at(nm)};
}

void add_outer_product(Matrix3<long double>& sum, const Vec3<long double>& a, const Vec3<long double>& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] += a[i] * b[j];
}

// Normal equations: with three curves, and long double, their squared condition number (about 50) is
// harmless.
Matrix3<double> fit_colour_matching() {
  Matrix3<long double> cones_cones;
  Matrix3<long double> matching_cones;
  const TabulatedCurve& grid = tables::cones_stockman_sharpe_2000_2deg_l;
  for (double nm = grid.first_nm; nm <= grid.last_nm(); nm += grid.step_nm) {
    add_outer_product(cones_cones, cones_at(nm), cones_at(nm));
    add_outer_product(matching_cones, colour_matching_at(nm), cones_at(nm));
  }
  return (matching_cones * inverse(cones_cones)).to<double>();
}

}  // namespace

double luminance_units_per_watt() {
  static const double k =
      photopic_luminance(tables::illuminant_cie_d65_d65).cdm2 /
      (integrate(tables::illuminant_cie_d65_d65, tables::cones_stockman_sharpe_2000_2deg_l) +
       integrate(tables::illuminant_cie_d65_d65, tables::cones_stockman_sharpe_2000_2deg_m));
  return k;
}

const Matrix3<double>& colour_matching_from_cones() {
  static const Matrix3<double> fit = fit_colour_matching();
  return fit;
}

const Matrix3<double>& xyz_from_lms() {
  static const Matrix3<double> matrix =
      (photopic_efficacy / luminance_units_per_watt()) * colour_matching_from_cones();
  return matrix;
}

const Matrix3<double>& lms_from_xyz() {
  static const Matrix3<double> matrix = inverse(xyz_from_lms().to<long double>()).to<double>();
  return matrix;
}

double rod_signal_per_scotopic_luminance() { return luminance_units_per_watt() / scotopic_efficacy; }

}  // namespace scotopic

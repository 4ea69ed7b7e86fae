// The measured curves everything rests on; src/receptors/tables names the source of each.
#pragma once

#include "receptors/spectrum.h"

namespace scotopic::tables {

/// Stockman & Sharpe 2000, 2 degree cone fundamentals per unit of energy, each with peak 1; 390-830 nm.
extern const TabulatedCurve cones_stockman_sharpe_2000_2deg_l;
extern const TabulatedCurve cones_stockman_sharpe_2000_2deg_m;
extern const TabulatedCurve cones_stockman_sharpe_2000_2deg_s;

/// CIE 1951 scotopic luminous efficiency; 380-780 nm.
extern const TabulatedCurve scotopic_cie_1951_v_prime;

/// CIE 1931 colour-matching functions, y being V(lambda); 360-830 nm.
extern const TabulatedCurve xyz_cie_1931_2deg_x;
extern const TabulatedCurve xyz_cie_1931_2deg_y;
extern const TabulatedCurve xyz_cie_1931_2deg_z;

/// Relative spectral powers; 380-780 nm.
extern const TabulatedCurve illuminant_cie_d65_d65;
extern const TabulatedCurve illuminant_cie_a_a;
extern const TabulatedCurve daylight_components_cie_s0;
extern const TabulatedCurve daylight_components_cie_s1;
extern const TabulatedCurve daylight_components_cie_s2;
extern const TabulatedCurve lamps_houser_2013_hps;
extern const TabulatedCurve lamps_houser_2013_led3000;
extern const TabulatedCurve lamps_houser_2013_led4000;

}  // namespace scotopic::tables

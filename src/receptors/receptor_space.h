// The units of the cone and rod signals, and the way between LMS and XYZ.
//
// Signals are in luminance units: with spectral radiance R in W/(m2 sr nm), q_i = k * integral(R l_i) for the
// cones and r = k * integral(R V') for the rods, k chosen so that D65 of 1 cd/m2 has L + M = 1. Such a D65
// has (L, M, S, r) = (.538679, .461321, .295866, .498581).
#pragma once

#include "kernel/matrix3.h"

namespace scotopic {

/// k: luminance units per W/(m2 sr); from the spectrum of D65, 1 nm sums (343.9301).
double luminance_units_per_watt();

/// CIE 1931 colour-matching functions as the least-squares combination of the cone fundamentals, 390-830 nm
/// in steps of 1 nm; both as tabulated (peak 1, no units).
const Matrix3<double>& colour_matching_from_cones();

/// XYZ in cd/m2 from LMS in luminance units: colour_matching_from_cones() times 683.002/k.
///
/// The cone fundamentals do not span CIE 1931 exactly. k comes from the spectrum, so a D65 white that goes
/// through lms_from_xyz() has L + M = .9939 per cd/m2, not 1; back through this matrix it returns to the same
/// XYZ.
const Matrix3<double>& xyz_from_lms();

/// The inverse of xyz_from_lms(); their product is the identity to 1e-14.
const Matrix3<double>& lms_from_xyz();

/// Rod signal in luminance units per cd/m2 of scotopic luminance: k / 1700.06.
double rod_signal_per_scotopic_luminance();

}  // namespace scotopic

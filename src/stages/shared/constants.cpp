#include "stages/shared/constants.h"

#include "receptors/receptor_space.h"
#include "receptors/spectrum.h"

namespace scotopic {
namespace {

double white_rod_signal(const AppearanceParameters& p) {
  // The very white the operator is given, so that a grey keeps its luminance to the last digit.
  const Vec3<double> white = p.xyz_from_rgb * Vec3<double>{1, 1, 1};
  return rod_signal_per_scotopic_luminance() *
         scotopic_luminance_from_xyz<double>(white, p.rods, sp_ratio_d65) / white[1];
}

}  // namespace

Matrix3<double> rgb_from_lms_cat02(const AppearanceParameters& p) {
  // CIE 159:2004, CIECAM02.
  constexpr Matrix3<double> cat02{
      {{{0.7328, 0.4296, -0.1624}, {-0.7036, 1.6975, 0.0061}, {0.0030, 0.0136, 0.9834}}}};
  const double per_luminance_unit = photopic_efficacy / luminance_units_per_watt();
  return per_luminance_unit * (inverse(p.xyz_from_rgb) * inverse(cat02));
}

OperatorConstants::OperatorConstants(const AppearanceParameters& p)
    : parameters(p),
      kernel(kernel_preset(p.model), kernel_scale_at(p, p.adaptation)),
      kernel_scale(kernel_scale_at(p, p.adaptation)),
      lms_from_rgb(lms_from_xyz() * p.xyz_from_rgb),
      rgb_from_lms(inverse(p.xyz_from_rgb) * xyz_from_lms()),
      luminance_from_rgb(p.xyz_from_rgb[1]),
      cone_white(lms_from_rgb * Vec3<double>{1, 1, 1}),
      rod_white(white_rod_signal(p)),
      shift(p.strength.all > 0 ? p.strength.shift : 0.0),
      luminance(p.luminance == LuminancePolicy::none || !(p.strength.all > 0) ? 0.0 : p.strength.luminance),
      chroma(p.strength.all > 0 ? p.strength.chroma : 0.0),
      mix(p.strength.all),
      gamut_from_rgb(identity3<double>()),
      rgb_from_gamut(identity3<double>()),
      project(p.xyz_from_gamut.has_value()),
      gamut_is_rgb(project && p.xyz_from_gamut->rows == p.xyz_from_rgb.rows) {
  if (!project || gamut_is_rgb) return;
  const Matrix3<double>& gamut = *p.xyz_from_gamut;
  gamut_from_rgb = inverse(gamut) * p.xyz_from_rgb;
  rgb_from_gamut = inverse(p.xyz_from_rgb) * gamut;
}

}  // namespace scotopic

#include "color/config/camera_spaces.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "color/config/transforms.h"
#include "color/primaries.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

struct CameraSpace {
  const char* name;
  std::vector<const char*> aliases;
  const char* identifier;  ///< in the ACES configs' namespace "ocio:"
  const char* family;
  const char* text;
  OCIO::ConstTransformRcPtr to_aces;
};

OCIO::ConstTransformRcPtr built_in(const char* style) {
  OCIO::BuiltinTransformRcPtr out = OCIO::BuiltinTransform::Create();
  out->setStyle(style);
  return out;
}

// Camera makers' primaries go to ACES by CAT02, as in OpenColorIO's own transforms and the ACES configs.
Matrix3<double> aces_by_cat02(const Primaries& p) {
  const Primaries& aces = match_matrix(gamut_xyz_matrix("ap0").value())->primaries;
  return inverse(xyz_from_rgb(aces)) * (cat02(p.white, aces.white) * xyz_from_rgb(p));
}

// "ARRI LogC4 Logarithmic Color Space, Specification" (2022), 3: a = (2^18 - 16)/117.45, b = (1023 -
// 95)/1023, c = 95/1023; code = (log2(a E + 64) - 6)/14 b + c, below E = -0.0180570 a line.
OCIO::ConstTransformRcPtr logc4() {
  const double a = (262144.0 - 16) / 117.45, b = (1023.0 - 95) / 1023, c = 95.0 / 1023;
  // Where the code is 0.
  const double start = (std::exp2(14 * (-c / b) + 6) - 64) / a;
  const Primaries awg4 = {{0.7347, 0.2653}, {0.1424, 0.8576}, {0.0991, -0.0308}, white_d65};
  return group_of(log_curve({2, b / 14, c - 6 * b / 14, a, 64, start}),
                  matrix_transform(aces_by_cat02(awg4)));
}

// "DaVinci Resolve 17 Wide Gamut Intermediate" (Blackmagic Design 2021): A, B, C, M and the linear cut.
OCIO::ConstTransformRcPtr davinci_intermediate() {
  const double a = 0.0075, b = 7.0, c = 0.07329248, m = 10.44426855, cut = 0.00262409;
  const Primaries gamut = {{0.8000, 0.3130}, {0.1682, 0.9877}, {0.0790, -0.1155}, white_d65};
  return group_of(log_curve({2, c, b * c, 1, a, cut, m}), matrix_transform(aces_by_cat02(gamut)));
}

// "Blackmagic Generation 5 Color Science" (Blackmagic Design 2021): A ln(x + B) + C, D x + E below the cut.
OCIO::ConstTransformRcPtr bmdfilm() {
  const double a = 0.08692876065491224, b = 0.005494072432257808, c = 0.5300133392291939, cut = 0.005;
  const Primaries gamut = {
      {0.7177215, 0.3171181}, {0.2280410, 0.8615690}, {0.1005841, -0.0820452}, {0.3127170, 0.3290312}};
  return group_of(log_curve({std::exp(1.0), a, c, 1, b, cut}), matrix_transform(aces_by_cat02(gamut)));
}

// "Apple Log Profile White Paper" (Apple 2023): code = c (R - R0)^2 from R0 to Rt, gamma log2(R + beta) +
// delta above. The parts meet with one slope: a log curve that goes on as a line, and the line bent to the
// square.
OCIO::ConstTransformRcPtr apple_log() {
  const double r0 = -0.05641088, rt = 0.01, c = 47.28711236, beta = 0.00964052, gamma = 0.08550479,
               delta = 0.69336945;
  const double code_t = c * (rt - r0) * (rt - r0), slope = 2 * c * (rt - r0);
  const OCIO::GradingRGBCurveTransformRcPtr toe =
      quadratic_toe({code_t - slope * (rt - r0), 0, code_t, code_t});
  toe->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
  const Matrix3<double> aces = inverse(gamut_xyz_matrix("ap0").value()) * gamut_xyz_matrix("rec2020").value();
  return group_of(toe, log_curve({2, gamma, delta, 1, beta, rt, slope}), matrix_transform(aces));
}

std::vector<CameraSpace> camera_spaces() {
  return {
      {"ACEScc",
       {"ACES - ACEScc", "acescc_ap1"},
       "acescc_ap1_scene",
       "ACES",
       "AMPAS S-2014-003, log grading space",
       built_in("ACEScc_to_ACES2065-1")},
      {"ACEScct",
       {"ACES - ACEScct", "acescct_ap1"},
       "acescct_ap1_scene",
       "ACES",
       "AMPAS S-2016-001, log grading space",
       built_in("ACEScct_to_ACES2065-1")},
      {"Apple Log",
       {"apple_log"},
       "applelog_rec2020_scene",
       "Input/Apple",
       "Apple Log, BT.2020 primaries",
       apple_log()},
      {"ARRI LogC3 (EI800)",
       {"arri_logc3_ei800", "logc3ei800_alexawide", "Input - ARRI - V3 LogC (EI800) - Wide Gamut"},
       "arrilogc3_awg3_scene",
       "Input/ARRI",
       "ARRI LogC3 at exposure index 800, ARRI Wide Gamut 3",
       built_in("ARRI_ALEXA-LOGC-EI800-AWG_to_ACES2065-1")},
      {"ARRI LogC4",
       {"arri_logc4"},
       "arrilogc4_awg4_scene",
       "Input/ARRI",
       "ARRI LogC4, ARRI Wide Gamut 4",
       logc4()},
      {"BMDFilm WideGamut Gen5",
       {"bmdfilm_widegamut_gen5"},
       "bmdfilm5_wg5_scene",
       "Input/BlackmagicDesign",
       "Blackmagic Film generation 5, Blackmagic Wide Gamut",
       bmdfilm()},
      {"DaVinci Intermediate WideGamut",
       {"davinci_intermediate_widegamut"},
       "davinci_dwg_scene",
       "Input/BlackmagicDesign",
       "DaVinci Intermediate, DaVinci Wide Gamut",
       davinci_intermediate()},
      {"CanonLog2 CinemaGamut D55",
       {"canonlog2_cinemagamut_d55", "canonlog2_cgamutday",
        "Input - Canon - Canon-Log2 - Cinema Gamut Daylight"},
       "canonlog2_cgamutd55_scene",
       "Input/Canon",
       "Canon Log 2, Cinema Gamut, daylight",
       built_in("CANON_CLOG2-CGAMUT_to_ACES2065-1")},
      {"CanonLog3 CinemaGamut D55",
       {"canonlog3_cinemagamut_d55", "canonlog3_cgamutday",
        "Input - Canon - Canon-Log3 - Cinema Gamut Daylight"},
       "canonlog3_cgamutd55_scene",
       "Input/Canon",
       "Canon Log 3, Cinema Gamut, daylight",
       built_in("CANON_CLOG3-CGAMUT_to_ACES2065-1")},
      {"V-Log V-Gamut",
       {"vlog_vgamut", "Input - Panasonic - V-Log - V-Gamut"},
       "vlog_vgamut_scene",
       "Input/Panasonic",
       "Panasonic V-Log, V-Gamut",
       built_in("PANASONIC_VLOG-VGAMUT_to_ACES2065-1")},
      {"Log3G10 REDWideGamutRGB",
       {"log3g10_redwidegamutrgb", "rl3g10_rwg", "Input - RED - REDLog3G10 - REDWideGamutRGB"},
       "redlog3g10_rwg_scene",
       "Input/RED",
       "RED Log3G10, REDWideGamutRGB",
       built_in("RED_LOG3G10-RWG_to_ACES2065-1")},
      {"S-Log3 S-Gamut3",
       {"slog3_sgamut3", "Input - Sony - S-Log3 - S-Gamut3"},
       "slog3_sgamut3_scene",
       "Input/Sony",
       "Sony S-Log3, S-Gamut3",
       built_in("SONY_SLOG3-SGAMUT3_to_ACES2065-1")},
      {"S-Log3 S-Gamut3.Cine",
       {"slog3_sgamut3cine", "slog3_sgamutcine", "Input - Sony - S-Log3 - S-Gamut3.Cine"},
       "slog3_sgamut3cine_scene",
       "Input/Sony",
       "Sony S-Log3, S-Gamut3.Cine",
       built_in("SONY_SLOG3-SGAMUT3.CINE_to_ACES2065-1")},
      {"S-Log3 Venice S-Gamut3",
       {"slog3_venice_sgamut3", "Input - Sony - S-Log3 - Venice S-Gamut3"},
       "slog3_sgamut3venice_scene",
       "Input/Sony",
       "Sony S-Log3, S-Gamut3 of Venice",
       built_in("SONY_SLOG3-SGAMUT3-VENICE_to_ACES2065-1")},
      {"S-Log3 Venice S-Gamut3.Cine",
       {"slog3_venice_sgamut3cine", "slog3_venice_sgamutcine",
        "Input - Sony - S-Log3 - Venice S-Gamut3.Cine"},
       "slog3_sgamut3cinevenice_scene",
       "Input/Sony",
       "Sony S-Log3, S-Gamut3.Cine of Venice",
       built_in("SONY_SLOG3-SGAMUT3.CINE-VENICE_to_ACES2065-1")},
  };
}

OCIO::ConstColorSpaceRcPtr space_of(const CameraSpace& camera) {
  OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE);
  space->setName(camera.name);
  for (const char* alias : camera.aliases) space->addAlias(alias);
  space->addAlias(camera.identifier);
  space->addAlias((std::string("ocio:") + camera.identifier).c_str());
  space->setFamily(camera.family);
  space->setEncoding("log");
  space->setDescription(camera.text);
  space->setBitDepth(OCIO::BIT_DEPTH_F32);
  space->setTransform(camera.to_aces, OCIO::COLORSPACE_DIR_TO_REFERENCE);
  return space;
}

}  // namespace

void add_camera_spaces(OCIO::Config& config) {
  for (const CameraSpace& camera : camera_spaces()) config.addColorSpace(space_of(camera));
}

}  // namespace scotopic

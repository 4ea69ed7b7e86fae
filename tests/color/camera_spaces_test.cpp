// Camera and grading encodings: codes as their makers and colour-science publish them, colours as
// OpenColorIO's own tests have them, the makers' formulas in long double, primaries, round trips.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "color/base_config.h"
#include "color/colour_config.h"
#include "color/file/file_colour.h"
#include "color/primaries.h"

namespace scotopic {
namespace {

using Real = long double;

Vec3<double> converted(const RowConverter& way, Vec3<double> v) {
  float p[3] = {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  way.apply(&p[0], &p[1], &p[2], 1);
  return {p[0], p[1], p[2]};
}

struct Published {
  const char* space;
  double light, code, tolerance;
  const char* source;
};
#define COLOUR "colour-science 0.4.6, tests of "
const Published published[] = {
    {"ACEScct", 0.18, 0.413588402492442, 1e-7, COLOUR "log_encoding_ACEScct"},
    {"ACEScct", 1, 0.554794520547945, 1e-7, COLOUR "log_encoding_ACEScct"},
    {"ACEScct", 0, 0.072905534195836, 1e-7, COLOUR "log_encoding_ACEScct"},
    {"ACEScc", 0.18, 0.413588402492442, 3e-7, COLOUR "log_encoding_ACEScc"},
    {"ACEScc", 1, 0.554794520547945, 3e-7, COLOUR "log_encoding_ACEScc"},
    {"Apple Log", 0, 0.150476452300913, 1e-6, COLOUR "log_encoding_AppleLogProfile"},
    {"Apple Log", 0.18, 0.488272458526868, 1e-6, COLOUR "log_encoding_AppleLogProfile"},
    {"Apple Log", 1, 0.694552983055191, 1e-6, COLOUR "log_encoding_AppleLogProfile"},
    {"ARRI LogC3 (EI800)", 0, 0.092809000000000, 1e-6, COLOUR "log_encoding_ARRILogC3"},
    {"ARRI LogC3 (EI800)", 0.18, 0.391006832034084, 1e-6, COLOUR "log_encoding_ARRILogC3"},
    {"ARRI LogC3 (EI800)", 1, 0.570631558120417, 1e-6, COLOUR "log_encoding_ARRILogC3"},
    {"ARRI LogC3 (EI800)", 0.18, 400.0 / 1023, 1e-5, "ARRI, ALEXA Mini LF manual, 15.1: 18 % at 400 of 1023"},
    {"ARRI LogC4", 0, 0.092864125122190, 1e-6, COLOUR "log_encoding_ARRILogC4"},
    {"ARRI LogC4", 0.18, 0.278395836548265, 1e-6, COLOUR "log_encoding_ARRILogC4"},
    {"ARRI LogC4", 1, 0.427519364835306, 1e-6, COLOUR "log_encoding_ARRILogC4"},
    {"BMDFilm WideGamut Gen5", 0, 0.092465753424658, 1e-6, COLOUR "oetf_BlackmagicFilmGeneration5"},
    {"BMDFilm WideGamut Gen5", 0.18, 0.383561643835617, 1e-6, COLOUR "oetf_BlackmagicFilmGeneration5"},
    {"BMDFilm WideGamut Gen5", 1, 0.530489624957305, 1e-6, COLOUR "oetf_BlackmagicFilmGeneration5"},
    {"BMDFilm WideGamut Gen5", 222.86, 0.999999631713769, 1e-6, COLOUR "oetf_BlackmagicFilmGeneration5"},
    {"DaVinci Intermediate WideGamut", -0.01, -0.104442685500000, 1e-6, COLOUR "oetf_DaVinciIntermediate"},
    {"DaVinci Intermediate WideGamut", 0.18, 0.336043272384855, 1e-6, COLOUR "oetf_DaVinciIntermediate"},
    {"DaVinci Intermediate WideGamut", 1, 0.513837441116225, 1e-6, COLOUR "oetf_DaVinciIntermediate"},
    {"DaVinci Intermediate WideGamut", 100, 0.999999987016872, 1e-6, COLOUR "oetf_DaVinciIntermediate"},
    {"CanonLog2 CinemaGamut D55", 0, 0.092864125000000, 1e-6, COLOUR "log_encoding_CanonLog2_v1_2"},
    {"CanonLog2 CinemaGamut D55", 0.18, 0.398254692561492, 1e-6, COLOUR "log_encoding_CanonLog2_v1_2"},
    {"CanonLog2 CinemaGamut D55", 1, 0.573229279230156, 1e-6, COLOUR "log_encoding_CanonLog2_v1_2"},
    {"CanonLog3 CinemaGamut D55", 0, 0.125122189999999, 1e-6, COLOUR "log_encoding_CanonLog3_v1_2"},
    {"CanonLog3 CinemaGamut D55", 0.18, 0.343389370373936, 1e-6, COLOUR "log_encoding_CanonLog3_v1_2"},
    {"CanonLog3 CinemaGamut D55", 1, 0.580277794216371, 1e-6, COLOUR "log_encoding_CanonLog3_v1_2"},
    {"Log3G10 REDWideGamutRGB", 0, 0.091551487714745, 1e-6, COLOUR "log_encoding_Log3G10_v3"},
    {"Log3G10 REDWideGamutRGB", 0.18, 0.333332912025992, 1e-6, COLOUR "log_encoding_Log3G10_v3"},
    {"Log3G10 REDWideGamutRGB", 0.18, 1.0 / 3, 1e-6, "DaVinci Resolve manual, Log3G10: mid grey at a third"},
    {"Log3G10 REDWideGamutRGB", 184.32, 1, 1e-5, "the same: 1 at ten stops above mid grey"},
    {"S-Log3 S-Gamut3", 0, 0.092864125122190, 1e-6, COLOUR "log_encoding_SLog3"},
    {"S-Log3 S-Gamut3", 0.18, 0.410557184750733, 1e-6, COLOUR "log_encoding_SLog3"},
    {"S-Log3 S-Gamut3", 1, 0.596027343690123, 1e-6, COLOUR "log_encoding_SLog3"},
    {"S-Log3 S-Gamut3.Cine", 0, 95.0 / 1023, 0.0005,
     "Sony's table as colour-science's log_encoding_SLog3 cites it"},
    {"S-Log3 S-Gamut3.Cine", 0.18, 420.0 / 1023, 0.0005, "the same, whole codes"},
    {"S-Log3 S-Gamut3.Cine", 0.9, 598.0 / 1023, 0.0005, "the same"},
    {"V-Log V-Gamut", 0, 0.125, 1e-6, COLOUR "log_encoding_VLog"},
    {"V-Log V-Gamut", 0.18, 0.423311448760136, 1e-6, COLOUR "log_encoding_VLog"},
    {"V-Log V-Gamut", 1, 0.599117700158146, 1e-6, COLOUR "log_encoding_VLog"},
    {"V-Log V-Gamut", 0, 128.0 / 1023, 0.0005,
     "Panasonic, V-Log/V-Gamut Reference Manual (2014), fig. 2.2, whole codes"},
    {"V-Log V-Gamut", 0.18, 433.0 / 1023, 0.0005, "the same"},
    {"V-Log V-Gamut", 0.9, 602.0 / 1023, 0.0005, "the same"},
};

TEST(CameraSpaces, hold_the_codes_that_were_published) {
  const ColourConfig config = ColourConfig::own();
  for (const Published& row : published) {
    const Vec3<double> code =
        converted(config.from_working(config.space(row.space)), {row.light, row.light, row.light});
    for (const double c : code)
      EXPECT_NEAR(c, row.code, row.tolerance) << row.space << " " << row.light << ": " << row.source;
  }
}

struct AcesColour {
  const char* space;
  Vec3<double> aces;  ///< ACES2065-1 of the codes 0.5, 0.4, 0.3
};
// OpenColorIO main of May 2026, tests/cpu/transforms/BuiltinTransform_tests.cpp.
const AcesColour aces_colours[] = {
    {"ACEScct", {0.386397222658, 0.158557251811, 0.043152537925}},
    {"ACEScc", {0.386397222658, 0.158557251811, 0.043152537925}},
    {"Apple Log", {0.153334766, 0.083515430, 0.032948254}},
    {"ARRI LogC3 (EI800)", {0.401621427766, 0.236455447604, 0.064830001192}},
    {"ARRI LogC4", {1.786878082249, 0.743018593362, 0.232840037656}},
    {"CanonLog2 CinemaGamut D55", {0.408435767126, 0.197486903378, 0.034204558318}},
    {"CanonLog3 CinemaGamut D55", {0.496034919950, 0.301015360499, 0.083691829261}},
    {"V-Log V-Gamut", {0.306918773245, 0.148128050597, 0.046334439047}},
    {"Log3G10 REDWideGamutRGB", {0.887988237100, 0.416932247547, -0.025442210717}},
    {"S-Log3 S-Gamut3", {0.342259707137, 0.172043362337, 0.057188031769}},
    {"S-Log3 S-Gamut3.Cine", {0.314942672433, 0.170408017753, 0.046854940520}},
    {"S-Log3 Venice S-Gamut3", {0.35101694, 0.17165215, 0.05479717}},
    {"S-Log3 Venice S-Gamut3.Cine", {0.32222527, 0.17032611, 0.04477848}},
};

TEST(CameraSpaces, give_the_aces_colours_of_opencolorios_own_tests) {
  const ColourConfig config = ColourConfig::own();
  const Matrix3<double> aces_from_working =
      inverse(gamut_xyz_matrix("ap0").value()) * config.xyz_from_working();
  for (const AcesColour& row : aces_colours) {
    const Vec3<double> aces =
        aces_from_working * converted(config.to_working(config.space(row.space)), {0.5, 0.4, 0.3});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(aces[c], row.aces[c], 2e-6) << row.space << c;
  }
}

struct Formula {
  const char* space;
  std::function<Real(Real)> light;  ///< of a code
  double relative;                  ///< of the light (at least 0.01), beside 5e-8
};

Real power(Real base, Real x) { return std::pow(base, x); }

std::vector<Formula> formulas() {
  return {
      {"ACEScct",
       [](Real v) {
         return v <= 0.155251141552511L ? (v - 0.0729055341958355L) / 10.5402377416545L
                                        : power(2, v * 17.52L - 9.72L);
       },
       3e-6},
      {"ACEScc",
       [](Real v) {
         return v <= (9.72L - 15) / 17.52L ? (power(2, v * 17.52L - 9.72L) - power(2, -16)) * 2
                                           : power(2, v * 17.52L - 9.72L);
       },
       6e-6},
      {"ARRI LogC3 (EI800)",
       [](Real v) {
         return v > 5.367655L * 0.010591L + 0.092809L
                    ? (power(10, (v - 0.385537L) / 0.247190L) - 0.052272L) / 5.555556L
                    : (v - 0.092809L) / 5.367655L;
       },
       1e-5},
      {"ARRI LogC4",
       [](Real v) {
         const Real a = (262144 - 16) / 117.45L, b = 928 / 1023.0L, c = 95 / 1023.0L;
         return (power(2, 14 * (v - c) / b + 6) - 64) / a;
       },
       3e-6},
      {"DaVinci Intermediate WideGamut",
       [](Real v) { return v > 0.02740668L ? power(2, v / 0.07329248L - 7) - 0.0075L : v / 10.44426855L; },
       3e-6},
      {"BMDFilm WideGamut Gen5",
       [](Real v) {
         return v < 8.283605932402494L * 0.005L + 0.09246575342465753L
                    ? (v - 0.09246575342465753L) / 8.283605932402494L
                    : std::exp((v - 0.5300133392291939L) / 0.08692876065491224L) - 0.005494072432257808L;
       },
       3e-6},
      {"S-Log3 S-Gamut3",
       [](Real v) {
         return v >= 171.2102946929L / 1023 ? power(10, (v * 1023 - 420) / 261.5L) * 0.19L - 0.01L
                                            : (v * 1023 - 95) * 0.01125L / (171.2102946929L - 95);
       },
       3e-6},
      {"V-Log V-Gamut",
       [](Real v) {
         return v < 0.181L ? (v - 0.125L) / 5.6L : power(10, (v - 0.598206L) / 0.241514L) - 0.00873L;
       },
       2e-5},
      {"Log3G10 REDWideGamutRGB", [](Real v) { return (power(10, v / 0.224282L) - 1) / 155.975327L - 0.01L; },
       3e-6},
      {"CanonLog2 CinemaGamut D55",
       [](Real v) {
         const Real x = (power(10, std::abs(v - 0.092864125L) / 0.24136077L) - 1) / 87.099375L;
         return 0.9L * (v < 0.092864125L ? -x : x);
       },
       3e-6},
      {"CanonLog3 CinemaGamut D55",
       [](Real v) {
         return 0.9L * (v < 0.097465473L   ? -(power(10, (0.12783901L - v) / 0.36726845L) - 1) / 14.98325L
                        : v <= 0.15277891L ? (v - 0.12512219L) / 1.9754798L
                                           : (power(10, (v - 0.12240537L) / 0.36726845L) - 1) / 14.98325L);
       },
       3e-6},
      {"Apple Log",
       [](Real v) {
         const Real c = 47.28711236L, r0 = -0.05641088L;
         return v < c * (0.01L - r0) * (0.01L - r0) ? std::sqrt(v / c) + r0
                                                    : power(2, (v - 0.69336945L) / 0.08550479L) - 0.00964052L;
       },
       3e-6},
  };
}

TEST(CameraSpaces, decode_by_their_makers_formulas_in_long_double) {
  const ColourConfig config = ColourConfig::own();
  for (const Formula& f : formulas()) {
    const RowConverter way = config.to_working(config.space(f.space));
    double worst = 0, at = 0;
    for (int i = 0; i <= 4000; ++i) {
      const double code = i / 4000.0;
      const Vec3<double> got = converted(way, {code, code, code});
      const double wanted = static_cast<double>(f.light(static_cast<Real>(static_cast<float>(code))));
      for (const double g : got) {
        const double error = std::max(0.0, std::abs(g - wanted) - 5e-8) / std::max(0.01, std::abs(wanted));
        if (error > worst) worst = error, at = code;
      }
    }
    std::printf("%-32s worst relative error %.1e at code %.4f\n", f.space, worst, at);
    EXPECT_LE(worst, f.relative) << f.space << " at code " << at;
  }
}

const std::vector<std::string> all_spaces = {"ACEScc",
                                             "ACEScct",
                                             "Apple Log",
                                             "ARRI LogC3 (EI800)",
                                             "ARRI LogC4",
                                             "BMDFilm WideGamut Gen5",
                                             "DaVinci Intermediate WideGamut",
                                             "CanonLog2 CinemaGamut D55",
                                             "CanonLog3 CinemaGamut D55",
                                             "V-Log V-Gamut",
                                             "Log3G10 REDWideGamutRGB",
                                             "S-Log3 S-Gamut3",
                                             "S-Log3 S-Gamut3.Cine",
                                             "S-Log3 Venice S-Gamut3",
                                             "S-Log3 Venice S-Gamut3.Cine",
                                             "sRGB - Texture",
                                             "sRGB - Display",
                                             "Rec.1886 Rec.709 - Display",
                                             "Rec.2100-PQ - Display",
                                             "Rec.2100-HLG - Display"};

// Light of strong colours loses its small components to float in the matrices: greys, and colours within four
// stops.
TEST(CameraSpaces, come_back_to_1e_6) {
  const ColourConfig config = ColourConfig::own();
  for (const std::string& name : all_spaces) {
    const RowConverter to = config.to_working(config.space(name)),
                       from = config.from_working(config.space(name));
    double worst = 0;
    Vec3<double> at{};
    for (int i = 0; i <= 1000; ++i)
      for (const Vec3<double>& tint : {Vec3<double>{0, 0, 0}, {0.05, 0, -0.03}, {-0.05, 0.04, 0.05}}) {
        const double grey = 0.1 + 0.8 * i / 1000;
        const Vec3<double> code = {grey + tint[0], grey + tint[1], grey + tint[2]};
        const Vec3<double> back = converted(from, converted(to, code));
        for (std::size_t c = 0; c < 3; ++c) {
          const double error = std::abs(back[c] - static_cast<double>(static_cast<float>(code[c])));
          if (error > worst) worst = error, at = code;
        }
      }
    std::printf("%-32s comes back to %.1e, worst (%.3f, %.3f, %.3f)\n", name.c_str(), worst, at[0], at[1],
                at[2]);
    EXPECT_LE(worst, 1e-6) << name;
  }
}

struct Columns {
  const char* space;
  Matrix3<double> aces;  ///< ACES2065-1 from its linear RGB
};
// As the CLF files of the OpenColorIO ACES configs print them.
const Columns columns[] = {
    {"ARRI LogC4",
     {{{{0.750957362824734, 0.144422786709757, 0.104619850465509},
        {0.000821837079380207, 1.007397584885, -0.00821942196438358},
        {-0.000499952143533471, -0.000854177231436971, 1.00135412937497}}}}},
    {"DaVinci Intermediate WideGamut",
     {{{{0.748270290272981, 0.167694659554328, 0.0840350501726906},
        {0.0208421234689102, 1.11190474268894, -0.132746866157851},
        {-0.0915122574225729, -0.127746712807307, 1.21925897022988}}}}},
    {"BMDFilm WideGamut Gen5",
     {{{{0.647091325580708, 0.242595385134207, 0.110313289285085},
        {0.0651915997328519, 1.02504756760476, -0.0902391673376125},
        {-0.0275570729194699, -0.0805887097177784, 1.10814578263725}}}}},
    {"ARRI LogC3 (EI800)",
     {{{{0.680205505106279, 0.236136601606481, 0.0836578932872398},
        {0.0854149797421404, 1.01747087860704, -0.102885858349182},
        {0.00205652166929683, -0.0625625003847921, 1.06050597871549}}}}},
    {"V-Log V-Gamut",
     {{{{0.72461670413153, 0.166915288193706, 0.108468007674764},
        {0.021390245413146, 0.984908155703054, -0.00629840111620089},
        {-0.00923556287076561, -0.00105690563900513, 1.01029246850977}}}}},
    {"S-Log3 S-Gamut3.Cine",
     {{{{0.638788667185978, 0.272351433711262, 0.0888598991027595},
        {-0.00391590602528224, 1.0880732308974, -0.0841573248721177},
        {-0.0299072021239151, -0.0264325799101947, 1.05633978203411}}}}},
};

TEST(CameraSpaces, have_the_primaries_of_the_aces_configs) {
  const ColourConfig config = ColourConfig::own();
  const Matrix3<double> aces_from_working =
      inverse(gamut_xyz_matrix("ap0").value()) * config.xyz_from_working();
  for (const Columns& row : columns) {
    const RowConverter to = config.to_working(config.space(row.space)),
                       from = config.from_working(config.space(row.space));
    const Vec3<double> grey = converted(from, {0.5, 0.5, 0.5}), black = converted(from, {0, 0, 0});
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3<double> code = black;
      code[c] = grey[c];
      const Vec3<double> aces = aces_from_working * converted(to, code);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(aces[k], 0.5 * row.aces[k][c], 2e-6) << row.space << c << k;
    }
  }
}

TEST(CameraSpaces, go_by_the_names_and_identifiers_of_the_aces_configs) {
  const ColourConfig config = ColourConfig::own();
  const std::pair<const char*, const char*> names[] = {
      {"ocio:arrilogc4_awg4_scene", "ARRI LogC4"},
      {"arrilogc4_awg4_scene", "ARRI LogC4"},
      {"arri_logc4", "ARRI LogC4"},
      {"arri_logc3_ei800", "ARRI LogC3 (EI800)"},
      {"Input - ARRI - V3 LogC (EI800) - Wide Gamut", "ARRI LogC3 (EI800)"},
      {"davinci_intermediate_widegamut", "DaVinci Intermediate WideGamut"},
      {"ocio:davinci_dwg_scene", "DaVinci Intermediate WideGamut"},
      {"slog3_sgamut3cine", "S-Log3 S-Gamut3.Cine"},
      {"vlog_vgamut", "V-Log V-Gamut"},
      {"rl3g10_rwg", "Log3G10 REDWideGamutRGB"},
      {"canonlog2_cgamutday", "CanonLog2 CinemaGamut D55"},
      {"apple_log", "Apple Log"},
      {"ACES - ACEScc", "ACEScc"},
      {"acescct_ap1", "ACEScct"},
      {"rec2100_hlg_display", "Rec.2100-HLG - Display"}};
  for (const auto& [name, space] : names) EXPECT_EQ(config.resolve(name), space) << name;
}

}  // namespace
}  // namespace scotopic

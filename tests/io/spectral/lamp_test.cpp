// An eye that is used to the lamp, on spectra: white under the lamp goes to grey as far as CIECAM02 says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "adaptation/chromatic_adaptation.h"
#include "io/spectral/scene.h"
#include "pipeline/run.h"
#include "receptors/receptor_space.h"
#include "receptors/support.h"
#include "stages/reference.h"
#include "stages/shared/colour_difference.h"

namespace scotopic {
namespace {

constexpr double cdm2 = 0.1;

ImageSettings settings(const Vec3<double>& lamp, const char* effects) {
  ImageSettings s(ColourConfig::own());
  s.choice.adaptation = cdm2;
  s.choice.white_luminance = 1;
  s.choice.stages.set_effects(effects);
  s.choice.stages.set_pixel_stages(s.choice.parameters);
  s.choice.lamp = lamp;
  set_primaries(s.choice, s.config);
  add_stages(s);
  return s;
}

/// R, G, B of the file's only row.
std::vector<Vec3<double>> seen(const std::string& in, const std::string& out, const ImageSettings& s) {
  ImageJob job;
  job.input = in;
  job.output = out;
  ExactEvaluators evaluators;
  run_image(job, s, evaluators, {});
  const auto source = open_source(out, Limits{});
  Band band;
  source->read(0, 0, 1, band);
  std::vector<Vec3<double>> rgb(test::macbeth_patches);
  const auto& channels = source->subimages()[0].channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::vector<float> row(test::macbeth_patches);
    load_row(band.channels[c].row(0), test::macbeth_patches, row.data());
    const std::size_t place = std::string("RGB").find(channels[c].name);
    for (std::size_t i = 0; i < test::macbeth_patches; ++i) rgb[i][place] = row[i];
  }
  return rgb;
}

Vec3<double> white_under(const char* lamp) {
  const auto truth = test::true_signals(test::lit({test::SceneSpectrum(471, 1.0)}, test::lamp(lamp), 1)[0]);
  return {truth[4], truth[5], truth[6]};
}

TEST(SpectralLamp, colours_are_those_of_cat16_on_what_the_bands_are) {
  const test::TemporaryFolder folder;
  test::WorstError worst;
  for (const char* lamp : {"a", "hps", "led3000"}) {
    const auto light = test::write_macbeth(folder / "chart.exr", lamp, cdm2, 1);
    const Vec3<double> white = white_under(lamp);
    const ImageSettings s = settings(white, "none");
    const Matrix3<double>& xyz_from_rgb = s.choice.parameters.xyz_from_rgb;
    const Matrix3<double> m = adapt_to_lamp(white, adaptation_degree(cdm2));
    const auto rgb = seen(folder / "chart.exr", folder / "seen.exr", s);
    for (std::size_t i = 0; i < test::macbeth_patches; ++i) {
      const auto truth = test::true_signals(light[i]);
      const Vec3<double> came = inverse(xyz_from_rgb) * Vec3<double>{truth[4], truth[5], truth[6]};
      const Vec3<double> expected = m * Vec3<double>{truth[4], truth[5], truth[6]};
      const Vec3<double> in_gamut = inverse(xyz_from_rgb) * expected;
      // Those that fade are tests/pipeline's.
      if (std::min({came[0], came[1], came[2], in_gamut[0], in_gamut[1], in_gamut[2]}) < 0) continue;
      worst.add(std::string(lamp) + " patch " + std::to_string(i + 1),
                exposed_difference(expected, xyz_from_rgb * rgb[i]), 0.0, 0.05);
    }
  }
  worst.expect_within("dE00 against CAT16 on CIE 1931 integrals");
}

// Cones' own signals, which no RGB has, are adapted too; the rods' are not.
TEST(SpectralLamp, receptors_of_spectra_are_adapted_and_rods_are_not) {
  const test::TemporaryFolder folder;
  test::WorstError worst;
  for (const char* lamp : {"a", "led3000"}) {
    const auto light = test::write_macbeth(folder / "chart.exr", lamp, cdm2, 1);
    const Vec3<double> white = white_under(lamp);
    const ImageSettings s = settings(white, "shift,luminance,chroma");
    const AppearanceParameters p = parameters_of(s.choice, cdm2, 1);
    const AppearanceReference reference(p);
    const Matrix3<double> m = adapt_to_lamp(white, adaptation_degree(cdm2));
    const auto rgb = seen(folder / "chart.exr", folder / "seen.exr", s);
    int compared = 0;
    for (std::size_t i = 0; i < test::macbeth_patches; ++i) {
      const auto truth = test::true_signals(light[i]);
      const Vec3<double> xyz = {truth[4], truth[5], truth[6]};
      const Vec3<double> came = inverse(p.xyz_from_rgb) * xyz, in_gamut = inverse(p.xyz_from_rgb) * (m * xyz);
      if (std::min({came[0], came[1], came[2], in_gamut[0], in_gamut[1], in_gamut[2]}) < 0) continue;
      const Vec3<double> cones =
          lms_from_xyz() * (m * (xyz_from_lms() * Vec3<double>{truth[0], truth[1], truth[2]}));
      const Vec3<double> expected = reference({in_gamut, cones, truth[3]});
      worst.add(std::string(lamp) + " patch " + std::to_string(i + 1),
                exposed_difference(p.xyz_from_rgb * expected, p.xyz_from_rgb * rgb[i]), 0.0, 0.05);
      ++compared;
    }
    EXPECT_GE(compared, 18) << lamp;
  }
  worst.expect_within("dE00 of what is seen against the reference on adapted signals");
}

}  // namespace
}  // namespace scotopic

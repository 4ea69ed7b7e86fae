// A light-adapted eye sees the colorimetric image: what the bands are by CIE 1931, through the whole program.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "stages/shared/colour_difference.h"
#include "pipeline/apply_image.h"
#include "pipeline/lmsr_image.h"
#include "io/spectral/spectral_source.h"
#include "receptors/support.h"
#include "io/spectral/scene.h"

namespace scotopic {
namespace {

Band read_pixels(const std::string& file) {
  const auto source = open_source(file, Limits{});
  Band band;
  source->read(0, 0, 2, band);
  return band;
}

float value(const Band& band, const std::string& name, const std::string& file, int i) {
  const auto source = open_source(file, Limits{});
  const auto& channels = source->subimages()[0].channels;
  for (std::size_t c = 0; c < channels.size(); ++c)
    if (channels[c].name == name) {
      std::vector<float> row(test::macbeth_patches);
      load_row(band.channels[c].row(0), test::macbeth_patches, row.data());
      return row[static_cast<std::size_t>(i)];
    }
  ADD_FAILURE() << "no channel " << name;
  return 0;
}

TEST(SpectralApply, light_adapted_result_is_the_cie_1931_image) {
  const test::TemporaryFolder folder;
  const ColourConfig config = ColourConfig::own();
  test::WorstError worst;
  for (const char* lamp : {"d65", "a", "moon", "hps", "lps", "led3000", "led4000"}) {
    const auto light = test::write_macbeth(folder / "chart.exr", lamp, 100.0, 2);
    const auto source = open_spectral_source(folder / "chart.exr", {}, Limits{});
    ASSERT_NE(source, nullptr);
    const std::string output = folder / "seen.exr";
    {
      OutputFile file(output);
      const ImageLayout layout = plan_layout(*source, output, config, {});
      AppearanceParameters parameters;
      parameters.adaptation = 5.0;
      parameters.white_luminance = 1.0;
      parameters.xyz_from_rgb = config.xyz_from_working();
      const Evaluator evaluator("float", parameters, Precision::single);
      ImageStages stages;
      stages.evaluator = &evaluator;
      apply_image(*source, layout, config, stages, file);
    }
    const Band seen = read_pixels(output);
    for (int i = 0; i < test::macbeth_patches; ++i) {
      const auto truth = test::true_signals(light[static_cast<std::size_t>(i)]);
      const Vec3<double> rgb = {value(seen, "R", output, i), value(seen, "G", output, i),
                                value(seen, "B", output, i)};
      worst.add(std::string(lamp) + " patch " + std::to_string(i + 1),
                exposed_difference({truth[4], truth[5], truth[6]}, config.xyz_from_working() * rgb), 0.0,
                0.05);
    }
  }
  worst.expect_within("dE00 against direct CIE 1931 integration");
}

TEST(SpectralApply, lmsr_file_holds_the_signals_and_says_their_unit) {
  const test::TemporaryFolder folder;
  const ColourConfig config = ColourConfig::own();
  const auto light = test::write_macbeth(folder / "chart.exr", "moon", 0.1, 2);
  SpectralOptions options;
  options.xyz = false;
  options.sampling = BandSampling::point;  // the standard sum of whole nanometres
  const auto source = open_spectral_source(folder / "chart.exr", options, Limits{});
  const std::string output = folder / "lmsr.exr";
  {
    OutputFile file(output);
    ImageLayout layout = plan_layout(*source, output, config, {});
    make_lmsr_layout(layout, output);
    set_stamps(layout, {{"scotopic:lmsrUnit", 1.0}});
    write_lmsr(*source, layout, config, {}, file);
  }
  const auto written = open_source(output, Limits{});
  EXPECT_EQ(written->colour(0, "").kind, ColourChannels::Kind::lmsr);
  EXPECT_EQ(written->subimages()[0].lmsr_unit, 1.0);
  const Band band = read_pixels(output);
  test::WorstError worst;
  const char* const names[] = {"L", "M", "S", "R"};
  for (int i = 0; i < test::macbeth_patches; ++i) {
    const auto truth = test::true_signals(light[static_cast<std::size_t>(i)]);
    for (std::size_t s = 0; s < 4; ++s)
      worst.add("patch " + std::to_string(i + 1) + " " + names[s], value(band, names[s], output, i), truth[s],
                2e-7 * truth[s]);
  }
  worst.expect_within("L, M, S, R in the file");
}

TEST(SpectralApply, rgb_becomes_the_receptor_signals_of_its_colour) {
  const test::TemporaryFolder folder;
  const ColourConfig config = ColourConfig::own();
  test::TestImage image;
  image.width = test::macbeth_patches;
  image.height = 2;
  image.parts.emplace_back();
  for (const char* name : {"R", "G", "B"})
    image.parts[0].push_back({name, std::vector<float>(2 * test::macbeth_patches, 0.5f)});
  test::write_exr(folder / "grey.exr", image);
  const auto source = open_source(folder / "grey.exr", Limits{});
  const std::string output = folder / "lmsr.exr";
  {
    OutputFile file(output);
    ImageRequest request;
    request.colourspace = config.working_space();
    ImageLayout layout = plan_layout(*source, output, config, request);
    make_lmsr_layout(layout, output);
    write_lmsr(*source, layout, config, {}, file);
  }
  const Band band = read_pixels(output);
  // White of luminance .5: the rods see it as D65; cones through the matrix miss the spectrum by .6 %.
  EXPECT_NEAR(value(band, "R", output, 3), 0.5 * 0.49857, 2e-4);
  EXPECT_NEAR(value(band, "L", output, 3) + value(band, "M", output, 3), 0.5 * 0.9939, 2e-4);
}

}  // namespace
}  // namespace scotopic

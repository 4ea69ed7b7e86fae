// OpenImageIO's weighted channel sum (oiiotool --chsum:weight=...) knows nothing of this project: it must
// agree.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include "io/spectral/spectral_source.h"
#include "receptors/receptor_space.h"
#include "receptors/support.h"
#include "io/spectral/scene.h"

namespace scotopic {
namespace {

TEST(OiioOracle, weighted_channel_sums_are_the_signals) {
  const test::TemporaryFolder folder;
  const double step = 10.0;
  const std::vector<double> centres = test::band_centres(380, step, 780);
  const auto light = test::lit(test::reflectances("munsell"), test::lamp("led4000"), 0.3);
  test::TestImage image;
  image.width = 42;
  image.height = 11;
  image.parts = {test::band_channels(light, 462, centres, step, test::stokes_name)};
  test::write_exr(folder / "munsell.exr", image);

  auto source = open_spectral_source(folder / "munsell.exr", {}, Limits{});
  ASSERT_NE(source, nullptr);
  Band band;
  source->read(0, 0, image.height, band);

  // In the order in which OpenImageIO has the channels: by name, and all names are of one length.
  const OIIO::ImageBuf buffer(folder / "munsell.exr");
  ASSERT_EQ(buffer.nchannels(), static_cast<int>(centres.size()));
  test::WorstError worst;
  for (const Signal signal : all_signals) {
    std::vector<float> weights;
    for (const double centre : centres)
      weights.push_back(
          static_cast<float>((signal <= Signal::rod ? luminance_units_per_watt() : 683.002) *
                             static_cast<double>(test::curve_area(sensitivity(signal), centre + step / 2) -
                                                 test::curve_area(sensitivity(signal), centre - step / 2))));
    const OIIO::ImageBuf sum = OIIO::ImageBufAlgo::channel_sum(buffer, weights);
    for (int i = 0; i < 462; ++i) {
      const double expected = sum.getchannel(i % image.width, i / image.width, 0, 0);
      worst.add("patch " + std::to_string(i) + " signal " + std::to_string(index(signal)),
                band.signals[index(signal)][static_cast<std::size_t>(i)], expected, 1e-6 * expected);
    }
  }
  worst.expect_within("against OpenImageIO");
}

}  // namespace
}  // namespace scotopic

// One night scene in every layout that renderers and cameras write: the signals must be the true ones.
#include <Imath/half.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <locale>

#include "base/error.h"
#include "io/spectral/scene.h"
#include "io/spectral/spectral_source.h"
#include "pipeline/apply_image.h"
#include "receptors/receptor_space.h"
#include "receptors/support.h"

namespace scotopic {
namespace {

using test::SceneSpectrum;
using test::TestChannel;
using test::TestImage;

constexpr int width = 37;
constexpr int height = 29;
constexpr int pixels = width * height;

std::array<std::vector<float>, 7> read_all(SpectralSource& source, int rows_at_once = 1 << 20) {
  const Subimage& picture = source.subimages()[0];
  std::array<std::vector<float>, 7> out;
  for (int y = picture.data.y0; y < picture.data.y1; y += rows_at_once) {
    Band band;
    source.read(0, y, std::min(rows_at_once, picture.data.y1 - y), band);
    for (std::size_t s = 0; s < out.size(); ++s)
      out[s].insert(out[s].end(), band.signals[s].begin(), band.signals[s].end());
  }
  return out;
}

std::unique_ptr<SpectralSource> open(const std::string& file, const SpectralOptions& options = {}) {
  auto source = open_spectral_source(file, options, Limits{});
  if (!source) throw std::runtime_error(file + " has no bands");
  return source;
}

// Signals of an image whose bands are bins: each band's value over its whole bin, areas of curves exact.
std::array<double, signal_count> truth_of_bins(const std::vector<TestChannel>& bands,
                                               const std::vector<double>& centres, double step, int pixel) {
  std::array<double, signal_count> out{};
  for (const Signal signal : all_signals) {
    long double sum = 0.0L;
    for (std::size_t b = 0; b < bands.size(); ++b)
      sum += bands[b].values[static_cast<std::size_t>(pixel)] *
             (test::curve_area(sensitivity(signal), centres[b] + step / 2) -
              test::curve_area(sensitivity(signal), centres[b] - step / 2));
    out[index(signal)] = static_cast<double>(
        sum * static_cast<long double>(signal <= Signal::rod ? luminance_units_per_watt() : 683.002));
  }
  return out;
}

void expect_truth(const std::string& where, const std::array<std::vector<float>, 7>& signals,
                  const std::vector<TestChannel>& bands, const std::vector<double>& centres, double step) {
  test::WorstError worst;
  for (int pixel = 0; pixel < 24; ++pixel) {
    const auto truth = truth_of_bins(bands, centres, step, pixel);
    for (std::size_t s = 0; s < signal_count; ++s)
      worst.add("patch " + std::to_string(pixel) + " signal " + std::to_string(s),
                signals[s][static_cast<std::size_t>(pixel)], truth[s], 1e-7 * truth[s]);
  }
  ASSERT_EQ(signals[0].size(), static_cast<std::size_t>(pixels));
  worst.expect_within(where.c_str());
}

struct Scene {
  std::vector<SceneSpectrum> light = test::lit(test::reflectances("macbeth"), test::lamp("moon"), 0.05);
  double step = 5.0;
  std::vector<double> centres = test::band_centres(380, step, 780);

  std::vector<TestChannel> bands(const std::function<std::string(double)>& name = test::stokes_name) const {
    return test::band_channels(light, pixels, centres, step, name);
  }
  TestImage image(std::vector<TestChannel> channels) const {
    TestImage out;
    out.width = width;
    out.height = height;
    out.parts = {std::move(channels)};
    out.text_attributes = {{"spectralLayoutVersion", "1.0"}, {"emissiveUnits", "W.m^-2.sr^-1"}};
    return out;
  }
};

std::vector<TestChannel> halves(std::vector<TestChannel> bands) {
  for (TestChannel& band : bands) {
    band.type = TestChannel::Type::half;
    for (float& value : band.values) value = Imath::half(value);  // what the file will hold
  }
  return bands;
}

TEST(SpectralSource, scanlines_tiles_windows_and_every_lossless_compression_are_alike) {
  const Scene scene;
  const test::TemporaryFolder folder;
  const auto bands = scene.bands();
  for (const int compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION})
    for (const bool tiled : {false, true}) {
      TestImage image = scene.image(bands);
      image.compression = compression;
      image.tiled = tiled;
      image.x0 = -5;
      image.y0 = 11;
      test::write_exr(folder / "image.exr", image);
      const auto source = open(folder / "image.exr");
      const std::string where = "compression " + std::to_string(compression) + (tiled ? " tiled" : "");
      expect_truth(where, read_all(*source), bands, scene.centres, scene.step);
      EXPECT_EQ(source->subimages()[0].data, (Window{-5, 11, -5 + width, 11 + height}));
    }
}

TEST(SpectralSource, any_number_of_rows_at_once_and_of_threads_gives_the_same_bits) {
  const Scene scene;
  const test::TemporaryFolder folder;
  test::write_exr(folder / "image.exr", scene.image(scene.bands()));
  const auto source = open(folder / "image.exr");
  const auto at_once = read_all(*source);
  EXPECT_EQ(at_once, read_all(*source, 16));
  for (const int threads : {1, 2, 7}) {
    set_threads(threads);
    EXPECT_EQ(at_once, read_all(*source)) << threads << " threads";
  }
  set_threads(0);
  EXPECT_EQ(source->subimages()[0].chunk_rows, 16);
}

TEST(SpectralSource, half_bands_are_weighed_as_they_are) {
  Scene scene;
  // Bright enough for half's range: under moonlight its bands would be subnormal numbers.
  scene.light = test::lit(test::reflectances("macbeth"), test::lamp("moon"), 50.0);
  const test::TemporaryFolder folder;
  const auto bands = halves(scene.bands());
  test::write_exr(folder / "half.exr", scene.image(bands));
  expect_truth("half", read_all(*open(folder / "half.exr")), bands, scene.centres, scene.step);
  auto mixed = scene.bands();
  std::copy_n(bands.begin(), 20, mixed.begin());
  test::write_exr(folder / "mixed.exr", scene.image(mixed));
  expect_truth("half and float", read_all(*open(folder / "mixed.exr")), mixed, scene.centres, scene.step);
}

TEST(SpectralSource, bands_may_lie_in_several_parts) {
  const Scene scene;
  const test::TemporaryFolder folder;
  const auto bands = scene.bands();
  TestImage image = scene.image({});
  image.parts = {{}, {}, {}};
  for (std::size_t b = 0; b < bands.size(); ++b) image.parts[b % 3].push_back(bands[b]);
  test::write_exr(folder / "parts.exr", image);
  expect_truth("three parts", read_all(*open(folder / "parts.exr")), bands, scene.centres, scene.step);
}

TEST(SpectralSource, names_in_hertz_layers_and_ocean_s_are_the_same_bands) {
  const Scene scene;
  const test::TemporaryFolder folder;
  const auto bands = scene.bands();
  const auto hertz = [](double nm) {
    char text[64];
    std::snprintf(text, sizeof text, "S0.%.15gHz", 299792458.0 / nm * 1e9);
    std::string name = text;
    std::replace(name.begin(), name.end(), '.', ',');
    name[2] = '.';
    return name;
  };
  test::write_exr(folder / "hertz.exr", scene.image(scene.bands(hertz)));
  expect_truth("hertz", read_all(*open(folder / "hertz.exr")), bands, scene.centres, scene.step);

  test::write_exr(folder / "layer.exr",
                  scene.image(scene.bands([](double nm) { return "light.key." + test::stokes_name(nm); })));
  expect_truth("layer", read_all(*open(folder / "layer.exr")), bands, scene.centres, scene.step);

  TestImage ocean = scene.image(bands);
  ocean.text_attributes.clear();
  for (std::size_t b = 0; b < bands.size(); ++b) {
    ocean.parts[0][b].name = "wl" + std::to_string(b);
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", scene.centres[b] * 1e-9);
    ocean.text_attributes.emplace_back("wl" + std::to_string(b) + ".wavelength", text);
  }
  test::write_exr(folder / "ocean.exr", ocean);
  expect_truth("ocean", read_all(*open(folder / "ocean.exr")), bands, scene.centres, scene.step);
}

TEST(SpectralSource, one_file_a_wavelength_is_one_image) {
  const Scene scene;
  const test::TemporaryFolder folder;
  const auto bands = scene.bands();
  for (std::size_t b = 0; b < bands.size(); ++b) {
    TestImage one = scene.image({bands[b]});
    one.text_attributes.clear();
    one.parts[0][0].name = "Y";
    test::write_exr(folder / ("night_" + std::to_string(static_cast<int>(scene.centres[b])) + ".exr"), one);
  }
  test::write_exr(folder / "night_beauty.exr", scene.image({bands[0]}));
  expect_truth("a file a wavelength", read_all(*open(folder / "night_%d.exr")), bands, scene.centres,
               scene.step);
  expect_truth("with digits", read_all(*open(folder / "night_%03d.exr")), bands, scene.centres, scene.step);
  EXPECT_THROW(open(folder / "night_%04d.exr"), Error);
  EXPECT_THROW(open(folder / "day_%d.exr"), Error);
}

TEST(SpectralSource, stokes_components_and_other_channels_do_not_disturb) {
  const Scene scene;
  const test::TemporaryFolder folder;
  auto channels = scene.bands();
  const auto bands = channels;
  for (const char* stokes : {"S1", "S2", "S3"})
    for (const TestChannel& band : bands) {
      channels.push_back(band);
      channels.back().name.replace(0, 2, stokes);
      for (float& value : channels.back().values) value *= -0.25f;
    }
  for (const char* name : {"R", "G", "B", "A", "depth.Z"})
    channels.push_back({name, std::vector<float>(pixels, 0.5f), TestChannel::Type::half});
  test::write_exr(folder / "image.exr", scene.image(channels));
  const auto source = open(folder / "image.exr");
  expect_truth("polarised", read_all(*source), bands, scene.centres, scene.step);
  EXPECT_EQ(source->subimages()[0].notes, std::vector<std::string>{"polarisation (S1 to S3) is ignored"});
  std::vector<std::string> passed;
  for (const Channel& channel : source->subimages()[0].channels) passed.push_back(channel.name);
  EXPECT_EQ(passed, (std::vector<std::string>{"A", "depth.Z"}));
  const ColourChannels colour = source->colour(0, "");
  EXPECT_EQ(colour.kind, ColourChannels::Kind::computed);
  EXPECT_EQ(colour.alpha, 0u);
  Band band;
  source->read(0, 0, height, band);
  std::vector<float> depth(width);
  load_row(band.channels[1].row(height - 1), width, depth.data());
  EXPECT_EQ(depth, std::vector<float>(width, 0.5f));
}

TEST(SpectralSource, reflectance_is_lit_by_the_illuminant) {
  const test::TemporaryFolder folder;
  const Scene scene;
  const auto patches = test::reflectances("macbeth");
  const auto channels = test::band_channels(patches, pixels, scene.centres, scene.step,
                                            [](double nm) { return "T" + test::stokes_name(nm).substr(2); });
  test::write_exr(folder / "t.exr", scene.image(channels));
  test::WorstError worst;
  for (const char* name : {"d65", "a", "moon", "led3000", "led4000", "e"}) {
    SpectralOptions options;
    options.illuminant_name = name;
    const auto source = open(folder / "t.exr", options);
    EXPECT_EQ(source->report().kind, SpectralKind::reflective);
    EXPECT_FALSE(source->subimages()[0].white_luminance.has_value());
    const auto signals = read_all(*source);
    const auto lit = test::lit(patches, test::lamp(name), 1.0);
    for (std::size_t patch = 0; patch < patches.size(); ++patch) {
      const auto truth = test::true_signals(lit[patch]);
      // Reflectances are smooth: 5 nm bins of them under the exact lamp against 1 nm sums.
      for (std::size_t s = 0; s < signal_count; ++s)
        worst.add(std::string(name) + " patch " + std::to_string(patch) + " signal " + std::to_string(s),
                  signals[s][patch], truth[s], 3e-3 * truth[s]);
    }
  }
  worst.expect_within("reflectance");
  SpectralOptions number;
  number.illuminant_name = "1.41";
  EXPECT_THROW(open(folder / "t.exr", number), Error);
}

TEST(SpectralSource, one_nanometre_points_are_the_ground_truth) {
  const test::TemporaryFolder folder;
  test::WorstError worst;
  for (const char* name : {"d65", "a", "moon", "hps", "lps", "led3000", "led4000"})
    for (const double level : {1e-4, 0.01, 1.0}) {
      Scene scene;
      scene.light = test::lit(test::reflectances("macbeth"), test::lamp(name), level);
      scene.step = 1.0;
      scene.centres = test::band_centres(test::scene_first_nm, 1.0, test::scene_last_nm);
      TestImage fine =
          scene.image(test::band_channels(scene.light, 24, scene.centres, 1.0, test::stokes_name));
      fine.width = 24;
      fine.height = 1;
      test::write_exr(folder / "fine.exr", fine);
      SpectralOptions options;
      options.sampling = BandSampling::point;
      const auto signals = read_all(*open(folder / "fine.exr", options));
      for (std::size_t patch = 0; patch < scene.light.size(); ++patch) {
        const auto truth = test::true_signals(scene.light[patch]);
        for (std::size_t s = 0; s < signal_count; ++s)
          worst.add(std::string(name) + " patch " + std::to_string(patch) + " signal " + std::to_string(s),
                    signals[s][patch], truth[s], 2e-7 * truth[s]);
      }
    }
  worst.expect_within("image against long double");
}

TEST(SpectralSource, units_are_decided_by_attribute_or_flag_and_said) {
  const Scene scene;
  const test::TemporaryFolder folder;
  struct Row {
    const char* attribute;
    std::optional<BandUnit> flag;
    double factor;
    const char* note;
  };
  for (const Row& row :
       {Row{"W.m^-2.sr^-1.nm^-1", {}, 1.0, "radiance per nm"}, Row{"W.m^-2.sr^-1", {}, 1.0, "assumed"},
        Row{"", {}, 1.0, "does not say"}, Row{"", BandUnit::per_band, 0.2, "per band, as asked"},
        Row{"W.m^-2.sr^-1.nm^-1", BandUnit::per_band, 0.2, "as asked"}}) {
    TestImage image = scene.image(scene.bands());
    image.text_attributes = {{"emissiveUnits", row.attribute}};
    test::write_exr(folder / "units.exr", image);
    SpectralOptions options;
    options.band_unit = row.flag;
    const auto source = open(folder / "units.exr", options);
    const double y = read_all(*source)[index(Signal::y)][18];
    const double truth = test::true_signals(scene.light[18])[index(Signal::y)];
    EXPECT_NEAR(y, row.factor * truth, 1e-3 * truth) << row.attribute;
    EXPECT_NE(source->report().notes.back().find(row.note), std::string::npos)
        << source->report().notes.back();
  }
}

TEST(SpectralSource, units_that_are_no_radiance_are_said_unasked) {
  const Scene scene;
  const test::TemporaryFolder folder;
  const auto notes_of = [&](const char* units, std::optional<BandUnit> flag) {
    TestImage image = scene.image(scene.bands());
    image.text_attributes = {{"emissiveUnits", units}};
    test::write_exr(folder / "units.exr", image);
    SpectralOptions options;
    options.band_unit = flag;
    return open(folder / "units.exr", options)->subimages().at(0).notes;
  };
  for (const char* units : {"", "W.m^-2.sr^-1", "W.m^-2.sr^-1.nm^-1", "W/(m2 sr nm)"})
    EXPECT_TRUE(notes_of(units, {}).empty()) << units;
  for (const char* units : {"cd.m^-2", "furlongs"}) {
    const std::vector<std::string> notes = notes_of(units, {});
    ASSERT_EQ(notes.size(), 1u) << units;
    EXPECT_NE(notes[0].find(units), std::string::npos);
    EXPECT_TRUE(notes_of(units, BandUnit::per_nm).empty()) << units;
  }
}

TEST(SpectralSource, a_later_layout_is_said_unasked) {
  const Scene scene;
  const test::TemporaryFolder folder;
  TestImage image = scene.image(scene.bands());
  image.text_attributes[0] = {"spectralLayoutVersion", "2.0"};
  test::write_exr(folder / "later.exr", image);
  EXPECT_EQ(open(folder / "later.exr")->subimages().at(0).notes,
            std::vector<std::string>{"spectralLayoutVersion \"2.0\" is read as \"1.0\""});
}

TEST(SpectralSource, bands_far_apart_are_said_unasked) {
  Scene scene;
  const test::TemporaryFolder folder;
  const auto notes_of = [&](double first, double step, double last) {
    scene.centres = test::band_centres(first, step, last);
    scene.step = step;
    test::write_exr(folder / "apart.exr", scene.image(scene.bands()));
    return open(folder / "apart.exr")->subimages().at(0).notes;
  };
  EXPECT_TRUE(notes_of(380, 50, 780).empty());
  EXPECT_EQ(notes_of(400, 100, 700),
            std::vector<std::string>{"up to 100 nm of the visible lie between two bands"});
  EXPECT_EQ(notes_of(200, 900, 1100).at(0).substr(0, 12), "up to 400 nm");
}

TEST(SpectralSource, infrared_is_left_out_and_said) {
  Scene scene;
  const test::TemporaryFolder folder;
  auto channels = scene.bands();
  const auto bands = channels;
  for (int nm = 900; nm <= 1000; nm += 50)
    channels.push_back({"S0." + std::to_string(nm) + "nm", std::vector<float>(pixels, NAN)});
  test::write_exr(folder / "image.exr", scene.image(channels));
  const auto source = open(folder / "image.exr");
  // The last visible bin now reaches half way to 900 nm, where there is next to nothing to see.
  const auto signals = read_all(*source);
  EXPECT_TRUE(std::isfinite(signals[0][0]));
  EXPECT_EQ(source->report().notes.back(), "3 bands outside the visible are not read");
}

TEST(SpectralSource, receptor_channels_become_luminance_units) {
  const test::TemporaryFolder folder;
  const Scene scene;
  TestImage image = scene.image({});
  image.text_attributes.clear();
  const char* const names[] = {"srf_l", "srf_m", "srf_s", "srf_rod"};
  for (std::size_t s = 0; s < 4; ++s) {
    TestChannel channel{names[s], {}};
    for (int i = 0; i < pixels; ++i)
      channel.values.push_back(static_cast<float>(
          test::true_signals(scene.light[static_cast<std::size_t>(i) % 24])[s] / luminance_units_per_watt()));
    image.parts[0].push_back(channel);
  }
  test::write_exr(folder / "srf.exr", image);
  SpectralOptions options;
  options.receptor_channels = {"srf_l", "srf_m", "srf_s", "srf_rod"};
  const auto signals = read_all(*open(folder / "srf.exr", options));
  for (std::size_t patch = 0; patch < 24; ++patch) {
    const auto truth = test::true_signals(scene.light[patch]);
    for (std::size_t s = 0; s < 4; ++s) EXPECT_NEAR(signals[s][patch], truth[s], 2e-7 * truth[s]);
    // XYZ can only come from LMS here: the fit of CIE 1931 on the cones.
    EXPECT_NEAR(signals[index(Signal::y)][patch], truth[index(Signal::y)], 0.02 * truth[index(Signal::y)]);
  }
}

TEST(SpectralSource, an_image_without_bands_is_none) {
  const test::TemporaryFolder folder;
  TestImage image;
  image.width = image.height = 4;
  image.parts = {{{"R", std::vector<float>(16, 1.0f)}, {"G", std::vector<float>(16, 1.0f)}}};
  test::write_exr(folder / "rgb.exr", image);
  EXPECT_EQ(open_spectral_source(folder / "rgb.exr", {}, Limits{}), nullptr);
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(SpectralSource, the_locale_s_decimal_comma_changes_nothing) {
  const Scene scene;
  const test::TemporaryFolder folder;
  test::write_exr(folder / "image.exr", scene.image(scene.bands()));
  const auto before = read_all(*open(folder / "image.exr"));
  const char* const german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  const std::locale classic = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  const auto after = read_all(*open(folder / "image.exr"));
  std::locale::global(classic);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(before, after);
  std::printf("C++ locale with decimal comma; C locale de_DE.UTF-8 %s\n",
              german ? "too" : "is not installed");
}

}  // namespace
}  // namespace scotopic

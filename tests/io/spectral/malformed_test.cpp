// Files with one fault each: refused with a line that names it.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "io/spectral/spectral_source.h"
#include "io/spectral/scene.h"

namespace scotopic {
namespace {

using test::TestChannel;
using test::TestImage;

TestImage image_of(const std::vector<std::string>& names,
                   TestChannel::Type type = TestChannel::Type::float32) {
  TestImage image;
  image.width = 20;
  image.height = 40;
  image.parts.emplace_back();
  for (const std::string& name : names)
    image.parts[0].push_back({name, std::vector<float>(800, 0.25f), type});
  return image;
}

void expect_refused(const std::string& file, const std::string& fault, ExitCode code,
                    const std::string& message) {
  try {
    auto source = open_spectral_source(file, {}, Limits{});
    ASSERT_NE(source, nullptr) << fault;
    Band band;
    source->read(0, source->subimages()[0].data.y0, source->subimages()[0].data.height(), band);
    ADD_FAILURE() << fault << ": was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << fault;
    EXPECT_FALSE(error.file().empty()) << fault;
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
        << fault << ": " << error.what() << ", expected: " << message;
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << fault;
  }
}

TEST(MalformedSpectra, each_fault_is_named) {
  const test::TemporaryFolder folder;
  struct Row {
    const char* fault;
    TestImage image;
    const char* message;
  };
  TestImage empty = image_of({"R", "G", "B"});
  empty.text_attributes = {{"spectralLayoutVersion", "1.0"}};
  const std::vector<Row> rows = {
      {"empty number", image_of({"S0.nm", "S0.500nm"}), "\"S0.nm\": has no number"},
      {"duplicate band", image_of({"S0.400nm", "S0.400,0nm", "S0.500nm"}), "is the same band as"},
      {"missing Stokes band", image_of({"S0.400nm", "S0.500nm", "S3.500nm"}),
       "S3 and S0 do not have the same bands"},
      {"S and T differ", image_of({"S0.400nm", "S0.500nm", "T.400nm", "T.505nm"}),
       "S0 and T do not have the same"},
      {"negative wavelength", image_of({"S0.-400nm", "S0.500nm"}), "negative wavelength"},
      {"point for comma", image_of({"S0.400.5nm", "S0.500nm"}), "decimal point where the layout has a comma"},
      {"comma and point", image_of({"S0.1.400,5nm", "S0.500nm"}), "mixes decimal comma and decimal point"},
      {"no bands", empty, "says it is spectral but has no band"},
      {"one band", image_of({"S0.500nm"}), "a single band, which has no width"},
      {"nothing visible", image_of({"S0.950nm", "S0.1000nm"}), "no visible band, only 950 to 1000 nm"},
      {"integers", image_of({"S0.400nm", "S0.500nm"}, TestChannel::Type::uint32),
       "holds integers, not light"},
  };
  for (const Row& row : rows) {
    test::write_exr(folder / "bad.exr", row.image);
    expect_refused(folder / "bad.exr", row.fault, ExitCode::input, row.message);
  }
}

TEST(MalformedSpectra, five_thousand_bands_are_too_many) {
  const test::TemporaryFolder folder;
  std::vector<std::string> names;
  for (int i = 0; i < 5000; ++i) names.push_back("S0." + std::to_string(300 + i) + "nm");
  TestImage image = image_of({});
  image.width = image.height = 1;
  for (const std::string& name : names) image.parts[0].push_back({name, {0.5f}, TestChannel::Type::half});
  test::write_exr(folder / "many.exr", image);
  expect_refused(folder / "many.exr", "bands", ExitCode::limit,
                 "channels 5000 exceeds the limit of 4096 (raise it with --max-channels)");
}

TEST(MalformedSpectra, files_cut_short_are_refused_at_every_length) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "cut.exr";
  TestImage image = image_of({"S0.400nm", "S0.500nm", "S0.600nm"});
  image.compression = 0;
  image.parts.push_back(image.parts[0]);
  for (TestChannel& channel : image.parts[1]) channel.name[5] = '5';  // 405 nm and so on
  for (const std::size_t parts : {2u, 1u}) {
    image.parts.resize(parts);
    test::write_exr(file, image);
    const auto size = std::filesystem::file_size(file);
    for (const double share : {0.999, 0.9, 0.5, 0.1, 0.01, 0.0}) {
      std::filesystem::resize_file(file, static_cast<std::uintmax_t>(static_cast<double>(size) * share));
      try {
        auto source = open_spectral_source(file, {}, Limits{});
        ASSERT_NE(source, nullptr);
        Band band;
        source->read(0, 0, image.height, band);
        ADD_FAILURE() << "cut to " << share << " with " << parts << " parts: was taken";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input);
        EXPECT_EQ(error.file(), file);
      }
      test::write_exr(file, image);
    }
  }
}

}  // namespace
}  // namespace scotopic

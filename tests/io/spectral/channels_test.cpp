#include <gtest/gtest.h>

#include "base/error.h"
#include "io/spectral/spectral_channels.h"
#include "receptors/support.h"

namespace scotopic {
namespace {

std::vector<ChannelName> named(const std::vector<std::string>& names) {
  std::vector<ChannelName> channels;
  for (const std::string& name : names) channels.push_back({name, std::nullopt});
  return channels;
}

std::optional<SpectralLayout> layout(const std::vector<std::string>& names, const std::string& layer = "") {
  return find_spectral_layout(named(names), layer, "image.exr");
}

TEST(SpectralChannels, wavelengths_are_read_in_every_notation) {
  struct Row {
    const char* text;
    double nm;
  };
  test::WorstError worst;
  for (const Row& row : {Row{"450nm", 450}, Row{"450,5nm", 450.5}, Row{"4,5e2nm", 450}, Row{"4,5E+2nm", 450},
                         Row{"0,45um", 450}, Row{",45um", 450}, Row{"450,nm", 450}, Row{"4500000e-4nm", 450},
                         Row{"450000pm", 450}, Row{"4,5e-7m", 450}, Row{"0,00045mm", 450},
                         Row{"299,792458THz", 1000}, Row{"0,599584916PHz", 500}, Row{"5,99584916e14Hz", 500},
                         Row{"599584,916GHz", 500}, Row{"0,000599584916EHz", 500}})
    worst.add(row.text, wavelength_from_text(row.text, row.text), row.nm, 1e-12 * row.nm);
  worst.expect_within("wavelengths");
}

TEST(SpectralChannels, bands_are_sorted_by_wavelength_not_by_name) {
  const auto found = layout({"B", "S0.1000nm", "S0.400nm", "S0.50,5nm", "S0.750THz"});
  ASSERT_TRUE(found.has_value());
  std::vector<std::size_t> order;
  for (const SpectralBand& band : found->bands) order.push_back(band.channel);
  EXPECT_EQ(order, (std::vector<std::size_t>{3, 4, 2, 1}));  // 50.5, 399.7, 400, 1000 nm
  EXPECT_EQ(found->kind, SpectralKind::emissive);
}

TEST(SpectralChannels, layouts_are_recognised) {
  struct Row {
    const char* what;
    std::vector<std::string> names;
    std::string layer;
    SpectralKind kind;
    std::size_t bands;
    std::size_t notes;
  };
  const std::vector<Row> rows = {
      {"emissive", {"A", "S0.400nm", "S0.500nm"}, "", SpectralKind::emissive, 2, 0},
      {"reflective", {"T.400nm", "T.500nm", "T.600nm"}, "", SpectralKind::reflective, 3, 0},
      {"polarised", {"S0.400nm", "S1.400nm", "S2.400nm", "S3.400nm"}, "", SpectralKind::emissive, 1, 1},
      {"emissive and reflective", {"S0.400nm", "T.400nm"}, "", SpectralKind::emissive, 1, 1},
      {"one layer", {"key.S0.400nm", "key.S0.500nm"}, "", SpectralKind::emissive, 2, 0},
      {"layer in a layer", {"a.b.S0.400nm", "a.b.S0.500nm"}, "a.b", SpectralKind::emissive, 2, 0},
      {"one of two layers", {"a.S0.400nm", "b.S0.400nm", "b.S0.500nm"}, "b", SpectralKind::emissive, 2, 0},
  };
  for (const Row& row : rows) {
    const auto found = layout(row.names, row.layer);
    ASSERT_TRUE(found.has_value()) << row.what;
    EXPECT_EQ(found->kind, row.kind) << row.what;
    EXPECT_EQ(found->bands.size(), row.bands) << row.what;
    EXPECT_EQ(found->notes.size(), row.notes) << row.what;
  }
}

TEST(SpectralChannels, other_images_have_no_bands) {
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"R", "G", "B", "A"},
                                             {"T.depth", "S0.mask", "S4.400nm", "T.400"},
                                             {"wl", "wlan"},
                                             {"S0", "T"},
                                             {},
                                             {"S0.400nn"},
                                             {"S0.400km2"}})
    EXPECT_FALSE(layout(names).has_value());
}

TEST(SpectralChannels, ocean_bands_take_their_wavelength_from_attributes) {
  const std::vector<ChannelName> channels = {{"wl1", 5.5e-7}, {"wl0", 4.5e-7}, {"A", std::nullopt}};
  const auto found = find_spectral_layout(channels, "", "ocean.exr");
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->bands.size(), 2u);
  EXPECT_EQ(found->bands[0].channel, 1u);
  EXPECT_NEAR(found->bands[0].nm, 450.0, 1e-9);
}

TEST(SpectralChannels, every_fault_has_its_own_line) {
  struct Row {
    std::vector<std::string> names;
    const char* message;
  };
  const std::vector<Row> rows = {
      {{"S0.nm"}, "has no number"},
      {{"S0.e5nm"}, "malformed number"},
      {{"S0.-400nm", "S0.500nm"}, "negative wavelength"},
      {{"S0.0nm", "S0.500nm"}, "not positive"},
      {{"S0.0Hz"}, "not positive"},
      {{"S0.400.5nm", "S0.500nm"}, "decimal point where the layout has a comma"},
      {{"S0.4.00,5nm"}, "mixes decimal comma and decimal point"},
      {{"S0.4,00,5nm"}, "more than one decimal comma"},
      {{"S0.4e99999nm"}, "out of range"},
      {{"S0.4+5nm"}, "malformed number"},
      {{"S0.400nm", "S0.4e2nm"}, "is the same band as"},
      {{"S0.400nm", "S0.500nm", "S1.400nm"}, "S1 and S0 do not have the same bands"},
      {{"S1.400nm"}, "S1 and S0 do not have the same bands"},
      {{"S0.400nm", "S0.500nm", "T.400nm", "T.510nm"}, "S0 and T do not have the same bands"},
      {{"a.S0.400nm", "b.S0.400nm"}, "several layers: \"a\", \"b\""},
      {{"wl0"}, "has no attribute with its wavelength"},
  };
  for (const Row& row : rows) {
    try {
      layout(row.names);
      ADD_FAILURE() << row.names[0] << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input);
      EXPECT_EQ(error.file(), "image.exr");
      EXPECT_NE(std::string(error.what()).find(row.message), std::string::npos)
          << row.names[0] << ": " << error.what() << ", expected: " << row.message;
    }
  }
}

TEST(SpectralChannels, receptor_channels_are_found_by_name) {
  const auto channels = named({"A", "rods", "l", "m", "s"});
  const std::vector<std::string> wanted = {"l", "m", "s", "rods"};
  const SpectralLayout found = receptor_layout(channels, wanted, "x.exr");
  EXPECT_EQ(found.kind, SpectralKind::receptors);
  EXPECT_EQ(found.bands[0].channel, 2u);
  EXPECT_EQ(found.bands[3].channel, 1u);
  const std::vector<std::string> missing = {"l", "m", "s", "rod"};
  EXPECT_THROW(receptor_layout(channels, missing, "x.exr"), Error);
}

}  // namespace
}  // namespace scotopic

#include "receptors/illuminant.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "receptors/rods.h"
#include "receptors/support.h"
#include "receptors/tables.h"

namespace scotopic {
namespace {

TEST(Illuminant, names_have_their_ratios) {
  struct Row {
    const char* name;
    double expected;
  };
  for (const Row& row : {Row{"d65", 2.4648}, Row{"e", 2.26}, Row{"moon", 2.04}, Row{"a", 1.41},
                         Row{"hps", 0.645}, Row{"led3000", 1.33}, Row{"led4000", 1.72}})
    EXPECT_EQ(parse_sp_ratio(row.name), row.expected) << row.name;
  EXPECT_EQ(named_illuminants().size(), 7u);
  EXPECT_EQ(illuminant_names(), "d65, e, moon, a, hps, led3000, led4000");
}

TEST(Illuminant, positive_numbers_are_ratios) {
  struct Row {
    const char* text;
    double expected;
  };
  for (const Row& row : {Row{"2.465", 2.465}, Row{"1", 1.0}, Row{".5", 0.5}, Row{"1e-3", 1e-3}})
    EXPECT_EQ(parse_sp_ratio(row.text), row.expected) << row.text;
}

TEST(Illuminant, anything_else_is_refused) {
  for (const char* text :
       {"", " ", "0", "-1", "nan", "inf", "1e999", "2.4 ", "2,4", "D65", "d6", "d655", "1x", "0x1"})
    EXPECT_FALSE(parse_sp_ratio(text).has_value()) << '"' << text << '"';
}

TEST(Illuminant, every_name_has_a_spectrum_of_its_ratio) {
  test::WorstError worst;
  for (const NamedIlluminant& illuminant : named_illuminants()) {
    const auto spectrum = illuminant_spectrum(illuminant.name);
    ASSERT_TRUE(spectrum.has_value()) << illuminant.name;
    // Moonlight of 4490 K is CIE daylight, and no measurement.
    worst.add(std::string(illuminant.name), sp_ratio(spectrum->curve()), illuminant.sp_ratio,
              illuminant.name == "moon" ? 0.015 : 3e-3 * std::max(1.0, illuminant.sp_ratio));
  }
  worst.expect_within("S/P of the spectrum against the named ratio");
  EXPECT_FALSE(illuminant_spectrum("candle").has_value());
}

TEST(Illuminant, daylight_of_6504_kelvin_is_d65) {
  // CIE 015 rounds M1 and M2 to three decimals; D65 is 6504 K on today's scale of temperature.
  const Spectrum daylight = cie_daylight(6504.0);
  test::WorstError worst;
  for (double nm = 380; nm <= 780; nm += 5)
    worst.add(std::to_string(nm), daylight.curve().at(nm), tables::illuminant_cie_d65_d65.at(nm), 0.15);
  worst.expect_within("D65 from its components");
}

TEST(Illuminant, default_leaves_the_rod_estimate_untouched) {
  const Vec3<double> xyz = {0.3, 0.4, 0.6};
  EXPECT_EQ(scotopic_luminance_from_xyz(xyz, RodEstimate::linear, *parse_sp_ratio("d65")),
            dot(scotopic_linear_from_xyz, xyz));
}

}  // namespace
}  // namespace scotopic

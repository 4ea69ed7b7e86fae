// Looks of an eye that is used to a coloured lamp: against the program's own lamp and pixel stages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "looks/chain/ocio_chain.h"
#include "looks/lut/baked_look.h"
#include "looks/lut/shipped_looks.h"
#include "looks/lut/look_chain.h"
#include "looks/lut/processor.h"
#include "looks/support.h"
#include "stages/reference.h"
#include "stages/shared/colour_difference.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

Lamp lamp_at(double x, double y) { return {{x / y, 1, (1 - x - y) / y}}; }
const Lamp sodium = lamp_at(0.5266, 0.4133), incandescent = lamp_at(0.4476, 0.4074),
           sky = lamp_at(0.2500, 0.2600);

LookSpec spec_of(double adaptation, const Lamp& lamp, const char* gamut = "rec709") {
  LookSpec spec;
  spec.parameters = test::adapted_to(adaptation, gamut);
  spec.lamp = lamp;
  spec.space = "working";
  return spec;
}

// Less near than looks without a lamp: what leaves the gamut fades, which bends the operator once more.
TEST(LampLook, is_as_near_to_the_program_as_stated) {
  const struct {
    const char* name;
    Lamp lamp;
    const char* working;
    double adaptation;
    std::size_t edge;
    double mean, p99, max;
  } rows[] = {{"sodium", sodium, "rec709", 0.01, 33, 0.19, 1.8, 4.5},
              {"sodium", sodium, "rec709", 0.1, 33, 0.19, 1.7, 4.5},
              {"sodium", sodium, "rec709", 3, 33, 0.18, 1.2, 3.5},
              {"sodium", sodium, "rec709", 30, 33, 0.2, 1.3, 3},
              {"sodium", sodium, "rec709", 0.1, 65, 0.06, 0.6, 2.5},
              {"sodium", sodium, "ap1", 0.1, 33, 0.12, 0.9, 3.5},
              {"incandescent", incandescent, "rec709", 0.1, 33, 0.15, 1.3, 3.5},
              {"sky", sky, "rec709", 0.1, 33, 0.12, 1.1, 6}};
  for (const auto& row : rows) {
    const LookSpec spec = spec_of(row.adaptation, row.lamp, row.working);
    const BakeError e =
        measure_look(spec, test::processor_of(look_chain(spec.parameters, row.edge, spec.lamp)));
    std::printf("%-12s %-6s La %-4g %zu: mean %.4f 99 %% %.4f max %.4f at (%.4g, %.4g, %.4g)\n", row.name,
                row.working, row.adaptation, row.edge, e.mean, e.p99, e.max, e.worst[0], e.worst[1],
                e.worst[2]);
    EXPECT_LE(e.mean, row.mean);
    EXPECT_LE(e.p99, row.p99);
    EXPECT_LE(e.max, row.max);
  }
}

// By the formulas of CIECAM02 and CAT16 on the lamp's own white, nothing of the code under test.
TEST(LampLook, takes_white_under_the_lamp_to_grey_as_far_as_the_degree_says) {
  for (const double adaptation : {10.0, 100.0}) {
    const LookSpec spec = spec_of(adaptation, sodium);
    const Matrix3<double>& xyz_from_rgb = spec.parameters.xyz_from_rgb;
    const double degree = 1 - std::exp(-(adaptation + 42) / 92) / 3.6;
    Vec3<double> expected;
    for (std::size_t i = 0; i < 3; ++i)
      expected[i] = degree * adapted_white[i] + (1 - degree) * sodium.white[i];
    const auto processor = test::processor_of(look_chain(spec.parameters, 33, spec.lamp));
    for (const double level : {0.01, 0.18, 1.0}) {
      const Vec3<double> rgb = inverse(xyz_from_rgb) * sodium.white;
      float pixel[3];
      for (std::size_t i = 0; i < 3; ++i) pixel[i] = static_cast<float>(level * rgb[i]);
      processor->applyRGB(pixel);
      const Vec3<double> got = {pixel[0] / level, pixel[1] / level, pixel[2] / level};
      EXPECT_LE(exposed_difference(expected, xyz_from_rgb * got), 0.2) << adaptation << " " << level;
    }
  }
}

TEST(LampLook, every_number_in_gives_a_finite_one_out_and_black_stays_black) {
  for (const Lamp& lamp : {sodium, sky}) {
    const LookSpec spec = spec_of(0.1, lamp);
    const OddPixels odd = odd_pixels(test::processor_of(look_chain(spec.parameters, 33, spec.lamp)));
    EXPECT_EQ(odd.not_finite, 0u);
    EXPECT_EQ(odd.alpha_changed, 0u);
    EXPECT_TRUE(odd.black_stays_black);
  }
}

TEST(LampLook, says_its_lamp_in_name_file_and_text_and_reads_it_back) {
  LookSpec spec = spec_of(0.1, sodium);
  spec.lamp->surround = dim_surround;
  EXPECT_EQ(look_name(spec), "Mesopic 0.1 nit lamp 0.5266 0.4133 dim");
  EXPECT_EQ(look_file_stem(spec), "filament2021_0.1_lamp_0.5266_0.4133_dim");
  EXPECT_EQ(night_name(spec), "Night 0.1 nit lamp 0.5266 0.4133 dim");
  const std::string text = spec_text(spec);
  const auto back = read_spec(text);
  ASSERT_TRUE(back && back->lamp);
  EXPECT_EQ(back->lamp->white, spec.lamp->white);
  EXPECT_EQ(back->lamp->surround, dim_surround);
  EXPECT_EQ(spec_text(*back), text);
  LookSpec none = spec;
  none.lamp.reset();
  EXPECT_EQ(spec_text(none).find("lamp"), std::string::npos);
  EXPECT_FALSE(read_spec(spec_text(none))->lamp);
  for (const auto& [from, to] : {std::pair("surround=0.9", "surround=2"), std::pair("lamp=", "lamp=-"),
                                 std::pair("; surround=0.9", "")}) {
    std::string damaged = text;
    damaged.replace(damaged.find(from), std::string(from).size(), to);
    EXPECT_FALSE(read_spec(damaged)) << damaged;
  }
}

// By day nothing is left to the pixel stages, but the lamp is.
TEST(LampLook, of_daylight_is_no_identity) {
  EXPECT_TRUE(is_identity(spec_of(10, sodium).parameters));
  EXPECT_FALSE(is_identity(spec_of(10, sodium)));
}

TEST(LampLook, names_are_short_enough_for_ocio_s_list_of_looks) {
  for (const NamedAdaptation& step : named_adaptations)
    for (const Model model : {Model::filament2021, Model::kirk2011, Model::safko2019, Model::cao2008}) {
      LookSpec spec = spec_of(step.adaptation, sodium);
      spec.parameters.model = model;
      spec.lamp->surround = dark_surround;
      EXPECT_LT(look_name(spec).size(), 64u) << look_name(spec);
      EXPECT_EQ(look_name(spec).find_first_of(",:|/"), std::string::npos);
    }
}

}  // namespace
}  // namespace scotopic

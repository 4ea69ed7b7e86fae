// Whose colours a file's are: what comes out in daylight is the light that the file's own tags say it holds.
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files/made_files.h"

namespace scotopic {
namespace {

using test::Rgb;

/// Linear Rec.709 that was written, whatever the output's own space.
Rgb light_in_709(const std::string& in, std::vector<std::string> more = {}, const std::string& says = "") {
  more.insert(more.end(), {"-d", "float", "--output-colorspace", "Linear Rec.709 (sRGB)", "-v"});
  const std::string out = test::place("light.exr");
  const test::Run run = test::apply(in, out, more);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find(says), std::string::npos) << "does not say: " << says << "\n" << run.err;
  if (run.exit_code != 0) return {};
  const std::vector<float> p = test::pixel_of(out, {"R", "G", "B"});
  return {p[0], p[1], p[2]};
}

void expect_near(const Rgb& got, const Rgb& wanted, double tolerance, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(got[i], wanted[i], tolerance) << what << ", component " << i;
}

test::Chunk gamma_chunk(std::uint32_t value) { return {"gAMA", test::big_endian(value)}; }
test::Chunk code_points(int primaries, int transfer, int range = 1) {
  return {"cICP", std::string({static_cast<char>(primaries), static_cast<char>(transfer), 0,
                               static_cast<char>(range)})};
}
const test::Chunk adobe_chrm = {"cHRM", test::big_endian(31270) + test::big_endian(32900) +
                                            test::big_endian(64000) + test::big_endian(33000) +
                                            test::big_endian(21000) + test::big_endian(71000) +
                                            test::big_endian(15000) + test::big_endian(6000)};
// Green of Adobe RGB (1998) in linear BT.709: columns of the two matrices, both of white D65.
const Rgb adobe_green = {-0.39836, 1.00000, -0.04293};

TEST(Colours, any_chromaticities_are_a_matrix) {
  const std::string file = test::place("in.exr");
  test::write_flat_exr(file, {0, 1, 0}, [](Imf::Header& h) {
    Imf::addChromaticities(h, {{0.64f, 0.33f}, {0.21f, 0.71f}, {0.15f, 0.06f}, {0.3127f, 0.3290f}});
  });
  expect_near(light_in_709(file, {}, "the file's chromaticities"), adobe_green, 1e-4, "Adobe RGB");
  // DCI-P3 with its own white: Bradford takes (1, 1, 1) to (1, 1, 1).
  test::write_flat_exr(file, {1, 1, 1}, [](Imf::Header& h) {
    Imf::addChromaticities(h, {{0.68f, 0.32f}, {0.265f, 0.69f}, {0.15f, 0.06f}, {0.314f, 0.351f}});
  });
  expect_near(light_in_709(file), {1, 1, 1}, 1e-5, "DCI-P3's white");
}

TEST(Colours, chromaticities_on_one_line_are_refused) {
  const std::string file = test::place("in.exr");
  test::write_flat_exr(file, {0, 1, 0}, [](Imf::Header& h) {
    Imf::addChromaticities(h, {{0.6f, 0.3f}, {0.4f, 0.3f}, {0.2f, 0.3f}, {0.3127f, 0.3290f}});
  });
  const test::Run run = test::apply(file, test::place("out.exr"));
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("span no colour space"), std::string::npos) << run.err;
}

struct NamedSpace {
  const char* id;
  Rgb pixel;
  Rgb wanted;
};

// A grey of 18 % in the codes that the makers published.
const NamedSpace camera_spaces[] = {
    {"ocio:acescct_ap1_scene", {0.4135884, 0.4135884, 0.4135884}, {0.18, 0.18, 0.18}},
    {"ocio:arrilogc4_awg4_scene", {0.278396, 0.278396, 0.278396}, {0.18, 0.18, 0.18}},
    {"arrilogc3_awg3_scene", {0.391007, 0.391007, 0.391007}, {0.18, 0.18, 0.18}},
    {"ocio:davinci_dwg_scene", {0.336043, 0.336043, 0.336043}, {0.18, 0.18, 0.18}},
    {"ocio:slog3_sgamut3cine_scene", {420.0 / 1023, 420.0 / 1023, 420.0 / 1023}, {0.18, 0.18, 0.18}},
    {"ocio:redlog3g10_rwg_scene", {1.0 / 3, 1.0 / 3, 1.0 / 3}, {0.18, 0.18, 0.18}},
    {"ocio:applelog_rec2020_scene", {0.488272, 0.488272, 0.488272}, {0.18, 0.18, 0.18}},
};

TEST(Colours, identifiers_of_the_color_interop_forum_are_understood) {
  // Light of BT.709: matrices from the primaries in the forum's tables, curves of 0.5: 2.2, 2.4, 1.8 powers,
  // sRGB's.
  const double srgb = std::pow((0.5 + 0.055) / 1.055, 2.4), g22 = std::pow(0.5, 2.2),
               g24 = std::pow(0.5, 2.4);
  const double adobe = std::pow(0.5, 563.0 / 256), g26 = std::pow(0.5, 2.6);
  const double pq = 92.2457, hlg = 1000 * std::pow(1.0 / 12, 1.2);  // cd/m2
  std::vector<NamedSpace> spaces = {
      {"lin_ap1_scene", {1, 0, 0}, {1.70505, -0.13026, -0.02400}},
      {"lin_ap0_scene", {1, 1, 1}, {1, 1, 1}},
      {"lin_rec709_scene", {1, 0.5, 0.25}, {1, 0.5, 0.25}},
      {"lin_p3d65_scene", {0, 1, 0}, {-0.22494, 1.04206, -0.07864}},
      {"lin_rec2020_scene", {0, 1, 0}, {-0.58764, 1.13290, -0.10058}},
      {"lin_adobergb_scene", {0, 1, 0}, adobe_green},
      {"lin_ciexyzd65_scene", {0.950456, 1, 1.089058}, {1, 1, 1}},
      {"srgb_rec709_scene", {0.5, 0.5, 0.5}, {srgb, srgb, srgb}},
      {"g24_rec709_scene", {0.5, 0.5, 0.5}, {g24, g24, g24}},
      {"g22_rec709_scene", {0.5, 0.5, 0.5}, {g22, g22, g22}},
      {"g18_rec709_scene", {0.5, 0, 0}, {std::pow(0.5, 1.8), 0, 0}},
      {"srgb_ap1_scene", {0.5, 0.5, 0.5}, {srgb, srgb, srgb}},
      {"g22_ap1_scene", {0.5, 0.5, 0.5}, {g22, g22, g22}},
      {"srgb_p3d65_scene", {0.5, 0.5, 0.5}, {srgb, srgb, srgb}},
      {"g22_adobergb_scene", {0.5, 0.5, 0.5}, {adobe, adobe, adobe}},
      {"super_vfx:g22_rec709_scene", {0.5, 0.5, 0.5}, {g22, g22, g22}},
      {"srgb_rec709_display", {0.5, 0.5, 0.5}, {srgb, srgb, srgb}},
      {"g24_rec709_display", {0.5, 0.5, 0.5}, {g24, g24, g24}},
      {"srgb_p3d65_display", {0.5, 0.5, 0.5}, {srgb, srgb, srgb}},
      {"srgbe_p3d65_display", {0.5, 0.5, 0.5}, {srgb, srgb, srgb}},
      {"pq_p3d65_display", {0.5, 0.5, 0.5}, {pq / 203, pq / 203, pq / 203}},
      {"pq_rec2020_display", {0.5, 0.5, 0.5}, {pq / 203, pq / 203, pq / 203}},
      {"hlg_rec2020_display", {0.5, 0.5, 0.5}, {hlg / 203, hlg / 203, hlg / 203}},
      {"g22_rec709_display", {0.5, 0.5, 0.5}, {g22, g22, g22}},
      {"g22_adobergb_display", {0.5, 0.5, 0.5}, {adobe, adobe, adobe}},
      {"g26_p3d65_display", {0.5, 0.5, 0.5}, {g26, g26, g26}},
      {"lin_p3d65_display", {0, 1, 0}, {-0.22494, 1.04206, -0.07864}},
      {"lin_rec709_display", {1, 0.5, 0.25}, {1, 0.5, 0.25}},
      {"lin_rec2020_display", {1, 1, 1}, {1, 1, 1}},
  };
  for (const NamedSpace& space : camera_spaces) spaces.push_back(space);
  const std::string file = test::place("in.exr");
  for (const NamedSpace& space : spaces) {
    test::write_flat_exr(file, space.pixel,
                         [&](Imf::Header& h) { h.insert("colorInteropID", Imf::StringAttribute(space.id)); });
    expect_near(light_in_709(file, {}, space.id), space.wanted, 1e-4, space.id);
  }
}

TEST(Colours, identifiers_that_are_not_understood_are_refused_by_name) {
  const std::string file = test::place("in.exr");
  for (const char* id : {"ocio:nlog_ngamut_scene", "adx10_apd_scene", "studio:secret", "data"}) {
    test::write_flat_exr(file, {1, 1, 1},
                         [&](Imf::Header& h) { h.insert("colorInteropID", Imf::StringAttribute(id)); });
    const test::Run run = test::apply(file, test::place("out.exr"));
    EXPECT_EQ(run.exit_code, 3) << id << run.err;
    EXPECT_NE(run.err.find(id), std::string::npos) << run.err;
    EXPECT_EQ(test::apply(file, test::place("out.exr"), {"--colorspace", "ACEScg"}).exit_code, 0) << id;
  }
  test::write_flat_exr(file, {1, 1, 1},
                       [&](Imf::Header& h) { h.insert("colorInteropID", Imf::StringAttribute("unknown")); });
  EXPECT_EQ(test::apply(file, test::place("out.exr")).exit_code, 0);
}

TEST(Colours, the_container_flag_of_aces_holds_over_all_and_a_conflict_is_said) {
  const std::string file = test::place("in.exr");
  test::write_flat_exr(file, {1, 0, 0}, [](Imf::Header& h) {
    h.insert("acesImageContainerFlag", Imf::IntAttribute(1));
    h.insert("colorInteropID", Imf::StringAttribute("lin_rec709_scene"));
  });
  // ST 2065-1's red in BT.709.
  expect_near(light_in_709(file, {}, "say different things of its colours"), {2.52169, -0.27648, -0.01538},
              2e-4, "AP0");
}

TEST(Colours, stale_tags_of_a_space_that_changed_are_gone) {
  const std::string file = test::place("in.exr");
  test::write_flat_exr(file, {1, 0, 0}, [](Imf::Header& h) {
    h.insert("acesImageContainerFlag", Imf::IntAttribute(1));
    h.insert("colorInteropID", Imf::StringAttribute("lin_ap0_scene"));
  });
  const std::string out = test::place("out.exr");
  ASSERT_EQ(test::apply(file, out, {"--output-colorspace", "Linear Rec.709 (sRGB)"}).exit_code, 0);
  const std::string bytes = [&] {
    std::string all;
    FILE* f = fopen(out.c_str(), "rb");
    for (int c; (c = fgetc(f)) != EOF;) all += static_cast<char>(c);
    fclose(f);
    return all;
  }();
  EXPECT_EQ(bytes.find("acesImageContainerFlag"), std::string::npos);
  EXPECT_EQ(bytes.find("colorInteropID"), std::string::npos);
  EXPECT_NE(bytes.find("chromaticities"), std::string::npos);
}

TEST(Colours, channels_x_y_z_are_cie_xyz) {
  const std::string file = test::place("in.exr");
  // XYZ (D65) of BT.709 (1, .05, .02).
  test::write_flat_exr(file, {{"", {{"X", 0.433874f}, {"Y", 0.249843f}, {"Z", 0.044300f}}}});
  const std::string out = test::place("out.exr");
  ASSERT_EQ(test::apply(file, out).exit_code, 0);
  const std::vector<float> p = test::pixel_of(out, {"R", "G", "B"});
  expect_near({p[0], p[1], p[2]}, {1, 0.05, 0.02}, 3e-4, "XYZ");
}

TEST(Colours, profiles_of_tiff_png_and_jpeg_are_applied) {
  const std::string profile = test::adobe_profile();
  test::write_flat_oiio(test::place("in.tif"), {0, 1, 0}, true, profile);
  test::write_flat_oiio(test::place("in.jpg"), {0, 1, 0}, false, profile);
  test::write_bytes(test::place("in.png"), test::flat_png({0, 65535, 0}, {test::png_profile(profile)}));
  for (const char* name : {"in.tif", "in.png"})
    expect_near(light_in_709(test::place(name), {}, "ICC profile"), adobe_green, 2e-4, name);
  expect_near(light_in_709(test::place("in.jpg"), {}, "ICC profile"), adobe_green, 8e-3,
              "JPEG");  // a code of 8 bits
}

TEST(Colours, what_is_written_for_a_profile_reads_back_to_half_a_code) {
  const std::string profile = test::adobe_profile();
  test::write_bytes(test::place("adobe.icc"), profile);
  test::write_flat_exr(test::place("in.exr"), {0.3, 0.2, 0.1});
  for (const char* name : {"out.tif", "out.png"}) {
    ASSERT_EQ(test::apply(test::place("in.exr"), test::place(name),
                          {"--icc", test::place("adobe.icc"), "-d", "uint16"})
                  .exit_code,
              0);
    // Half a code of 16 bits of gamma 2.2 at 0.1: 1e-5 of light.
    expect_near(light_in_709(test::place(name), {}, "ICC profile"), {0.3, 0.2, 0.1}, 2e-5, name);
  }
}

TEST(Colours, any_linear_space_is_stated_in_what_is_written_and_reads_back) {
  test::write_flat_exr(test::place("in.exr"), {0.3, 0.2, 0.1});
  for (const char* space :
       {"ACEScg", "Linear Rec.2020", "Linear P3-D65", "Linear Rec.709 (sRGB)", "CIE XYZ-D65"})
    for (const char* name : {"out.tif", "out.png", "out.exr"}) {
      const std::vector<std::string> more = {"--output-colorspace", space, "-d",
                                             name == std::string("out.png") ? "uint16" : "float"};
      const test::Run run = test::apply(test::place("in.exr"), test::place(name), more);
      ASSERT_EQ(run.exit_code, 0) << run.err;
      expect_near(light_in_709(test::place(name)), {0.3, 0.2, 0.1}, 1e-4, std::string(space) + " in " + name);
    }
}

TEST(Colours, chunks_of_png_are_understood) {
  const std::string file = test::place("in.png");
  const auto png = [&](std::uint16_t value, std::vector<test::Chunk> chunks) {
    test::write_bytes(file, test::flat_png({value, value, value}, chunks));
    return file;
  };
  const double v = 32768.0 / 65535;
  const auto grey = [](double x) { return Rgb{x, x, x}; };
  expect_near(light_in_709(png(32768, {gamma_chunk(100000)}), {}, "gAMA"), grey(v), 1e-5, "gAMA 1");
  expect_near(light_in_709(png(32768, {gamma_chunk(45455)})), grey(std::pow(v, 2.19998)), 1e-5,
              "gAMA .45455");
  expect_near(light_in_709(png(32768, {{"sRGB", std::string(1, '\0')}, gamma_chunk(45455)}), {}, "sRGB"),
              grey(std::pow((v + 0.055) / 1.055, 2.4)), 1e-5, "sRGB");
  expect_near(light_in_709(png(32768, {code_points(1, 13)}), {}, "cICP"),
              grey(std::pow((v + 0.055) / 1.055, 2.4)), 1e-5, "cICP sRGB");
  expect_near(light_in_709(png(32768, {code_points(9, 8)})), grey(v), 1e-5, "cICP linear");
  // Narrow range: 16 bits of black 4096, white 60160.
  expect_near(light_in_709(png(60160, {code_points(1, 8, 0)})), grey(1), 1e-5, "narrow white");
  expect_near(light_in_709(png(4096, {code_points(1, 8, 0)})), grey(0), 1e-5, "narrow black");
  test::write_bytes(file, test::flat_png({0, 65535, 0}, {gamma_chunk(45455), adobe_chrm}));
  expect_near(light_in_709(file, {}, "cHRM"), adobe_green, 1e-4, "cHRM");
}

TEST(Colours, pq_and_hlg_are_luminances_of_their_own) {
  const std::string file = test::place("in.png"), out = test::place("out.exr");
  // ST 2084's EOTF of .5 is 92.2457 cd/m2; BT.2100 HLG of .5 is 1000 (1/12)^1.2, of .75 203 (BT.2408, table
  // 1).
  const std::vector<std::tuple<int, double, double>> cases = {
      {16, 0.5, 92.2457}, {18, 0.5, 50.69}, {18, 0.75, 203.1}};
  for (const auto& [transfer, value, luminance] : cases) {
    const auto code = static_cast<std::uint16_t>(std::lround(value * 65535));
    test::write_bytes(file, test::flat_png({code, code, code}, {code_points(9, transfer)}));
    ASSERT_EQ(test::apply(file, out, {"-d", "float"}).exit_code, 0);
    const double unit = test::float_attribute(out, "whiteLuminance");
    EXPECT_EQ(unit, 203);
    EXPECT_NEAR(test::pixel_of(out, {"G"})[0] * unit, luminance, 2e-3 * luminance)
        << transfer << " " << value;
  }
}

TEST(Colours, code_points_that_are_not_rgb_or_not_known_are_refused) {
  const std::string file = test::place("in.png");
  for (const auto& chunk : {code_points(3, 13), code_points(1, 3), code_points(2, 2),
                            test::Chunk{"cICP", std::string("\x9\x10\x9\x1", 4)}}) {
    test::write_bytes(file, test::flat_png({9, 9, 9}, {chunk}));
    const test::Run run = test::apply(file, test::place("out.exr"));
    EXPECT_EQ(run.exit_code, 3) << run.err;
    EXPECT_NE(run.err.find("cICP"), std::string::npos) << run.err;
  }
}

TEST(Colours, straight_and_associated_alpha_are_the_same_light) {
  const std::string straight = test::place("in.png"), associated = test::place("in.exr");
  test::write_bytes(straight, test::flat_png({40000, 20000, 60000, 16384}, {gamma_chunk(100000)}));
  const double a = 16384.0 / 65535;
  const auto part = [&](double c) { return static_cast<float>(c / 65535 * a); };
  test::write_flat_exr(
      associated,
      {{"", {{"R", part(40000)}, {"G", part(20000)}, {"B", part(60000)}, {"A", static_cast<float>(a)}}}});
  const std::vector<std::string> night = {"--adaptation", "0.05", "--white-luminance", "0.5", "-d", "float"};
  ASSERT_EQ(test::apply(straight, test::place("a.exr"), night).exit_code, 0);
  ASSERT_EQ(test::apply(associated, test::place("b.exr"), night).exit_code, 0);
  const std::vector<float> x = test::pixel_of(test::place("a.exr"), {"R", "G", "B", "A"});
  const std::vector<float> y = test::pixel_of(test::place("b.exr"), {"R", "G", "B", "A"});
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(x[c], y[c], 1e-6) << c;
}

// A lamp's glow on nothing: an alpha of 0 beside light, which straight colour cannot show.
TEST(Colours, light_that_straight_alpha_hides_is_told) {
  const std::string file = test::place("glow.exr"), told = "light beside an alpha of 0";
  const auto is_told = [&](const std::string& in, const char* out) {
    const test::Run run = test::apply(in, test::place(out));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return test::says(run.err, told);
  };
  const auto glow = [&](float light, float alpha, const char* out) {
    test::write_flat_exr(file, {{"", {{"R", light}, {"G", light}, {"B", light}, {"A", alpha}}}});
    return is_told(file, out);
  };
  EXPECT_TRUE(glow(0.5f, 0, "out.png"));
  EXPECT_FALSE(glow(0.5f, 0, "out.exr"));
  EXPECT_FALSE(glow(0.5f, 0, "out.jpg"));
  EXPECT_FALSE(glow(0.5f, 0.25f, "out.png"));
  EXPECT_FALSE(glow(0, 0, "out.png"));
  // Whose code of no light is not 0.
  EXPECT_FALSE(
      test::says(test::apply(file, test::place("log.png"), {"--output-colorspace", "ACEScct"}).err, told));
  // Hidden before, hidden after: nobody has lost it.
  test::write_bytes(test::place("hidden.png"), test::flat_png({30000, 30000, 30000, 0}, {}));
  EXPECT_FALSE(is_told(test::place("hidden.png"), "out.png"));
}

}  // namespace
}  // namespace scotopic

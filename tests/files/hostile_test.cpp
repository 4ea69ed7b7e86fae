// Damaged profiles, metadata and LUTs, and option values that are none: one line, never a crash or an endless
// wait.
#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/run_program.h"
#include "files/made_files.h"

namespace scotopic {
namespace {

std::string with_number(std::string bytes, std::size_t at, std::uint32_t value) {
  return bytes.replace(at, 4, test::big_endian(value));
}

/// Where the profile's tag table has this tag.
std::size_t entry_of(const std::string& profile, const std::string& tag) { return profile.find(tag, 132); }

std::vector<std::string> damaged_profiles() {
  const std::string good = test::adobe_profile();
  const std::size_t desc = entry_of(good, "desc"), red = entry_of(good, "rTRC");
  return {with_number(good, 128, 0xffffffff),       // tags
          with_number(good, desc + 8, 0x7fffffff),  // size of a tag
          with_number(good, desc + 4, 0xfffffff0),  // offset
          with_number(good, desc + 8, 0),           // empty, what follows is shifted
          with_number(good, desc + 4, 140),         // within the table of tags
          with_number(good, red + 8, 100000),       // beyond the end
          with_number(good, 0, 0xffffffff),         // size of all
          good.substr(0, 200),
          good.substr(0, 100)};
}

void expect_one_line(const test::Run& run, int code, const std::string& what) {
  EXPECT_EQ(run.exit_code, code) << what << run.err;
  EXPECT_NE(run.err.find("damaged"), std::string::npos) << what << run.err;
}

TEST(Hostile, damaged_profiles_are_refused_embedded_and_given) {
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1});
  for (const std::string& profile : damaged_profiles()) {
    test::write_bytes(test::place("bad.icc"), profile);
    EXPECT_EQ(test::apply(test::place("in.exr"), test::place("out.tif"), {"--icc", test::place("bad.icc")})
                  .exit_code,
              6);
    test::write_bytes(test::place("in.png"), test::flat_png({1, 2, 3}, {test::png_profile(profile)}));
    expect_one_line(test::apply(test::place("in.png"), test::place("out.exr")), 3, "PNG");
  }
}

TEST(Hostile, deeply_nested_xmp_is_refused) {
  std::string xmp = "<x:xmpmeta xmlns:x='adobe:ns:meta/'>";
  for (int i = 0; i < 200000; ++i) xmp += "<a>";
  const std::string head = "XML:com.adobe.xmp";
  test::write_bytes(test::place("in.png"),
                    test::flat_png({1, 2, 3}, {{"iTXt", head + std::string(5, '\0') + xmp}}));
  expect_one_line(test::apply(test::place("in.png"), test::place("out.exr")), 3, "plain");
  test::write_bytes(
      test::place("in.png"),
      test::flat_png({1, 2, 3}, {{"iTXt", head + std::string("\0\1\0\0\0", 5) + test::packed(xmp)}}));
  expect_one_line(test::apply(test::place("in.png"), test::place("out.exr")), 3, "compressed");
  test::write_bytes(test::place("in.png"),
                    test::flat_png({1, 2, 3}, {{"zTXt", head + std::string(2, '\0') + test::packed(xmp)}}));
  expect_one_line(test::apply(test::place("in.png"), test::place("out.exr")), 3, "zTXt");
}

void write_lut_config(const std::string& file, const std::string& lut) {
  test::write_bytes(
      file,
      "ocio_profile_version: 2\nsearch_path: \".\"\n"
      "roles: {default: raw, scene_linear: lin, aces_interchange: lin}\n"
      "file_rules:\n  - !<Rule> {name: Default, colorspace: lin}\n"
      "displays:\n  d:\n    - !<View> {name: v, colorspace: x}\n"
      "colorspaces:\n  - !<ColorSpace> {name: raw, isdata: true}\n  - !<ColorSpace> {name: lin}\n"
      "  - !<ColorSpace> {name: x, to_scene_reference: !<FileTransform> {src: " +
          lut + "}}\n");
}

TEST(Hostile, a_lut_that_opencolorio_reads_without_end_is_refused) {
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1});
  test::write_bytes(test::place("x.csp"), "CSPLUTV100\n3D\nBEGIN METADATA\n");
  write_lut_config(test::place("c.ocio"), "x.csp");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--display", "d/v"}, {"--colorspace", "x"}}) {
    std::vector<std::string> arguments = {"--config", test::place("c.ocio")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_one_line(test::apply(test::place("in.exr"),
                                test::place(more[0] == "--display" ? "out.png" : "out.exr"), arguments),
                    6, more[0]);
  }
}

TEST(Hostile, a_damaged_profile_of_a_config_is_refused_at_once) {
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1});
  write_lut_config(test::place("c.ocio"), "x.icc");
  for (const std::string& profile : damaged_profiles()) {
    test::write_bytes(test::place("x.icc"), profile);
    const test::Run run = test::apply(test::place("in.exr"), test::place("out.exr"),
                                      {"--config", test::place("c.ocio"), "--colorspace", "x"});
    EXPECT_EQ(run.exit_code, 6) << run.err;
  }
}

TEST(Hostile, option_values_that_are_none_are_usage_errors) {
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1});
  const std::vector<std::vector<std::string>> bad = {{"--illuminant", "1e308"},
                                                     {"--illuminant", "1e-9"},
                                                     {"--config", ""},
                                                     {"--icc", ""},
                                                     {"--layer", ""},
                                                     {"--max-side", "010"},
                                                     {"--max-side", "0x10"},
                                                     {"--max-side", " 1"},
                                                     {"--max-side", "18446744073709551616"},
                                                     {"--max-side", "-1"},
                                                     {"--threads", "010"},
                                                     {"--max-side", "1e3"}};
  for (const std::vector<std::string>& arguments : bad) {
    const test::Run run = test::apply(test::place("in.exr"), test::place("out.exr"), arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments[0] << " '" << arguments[1] << "' " << run.err;
    EXPECT_NE(run.err.find(arguments[0]), std::string::npos) << run.err;
  }
  const test::Outcome empty =
      test::run_program({"explain", test::place("in.exr"), "--white-luminance", "1", "--effects", ""});
  EXPECT_EQ(empty.exit_code, 2) << empty.err;
}

TEST(Hostile, no_file_is_called_like_standard_output) {
  const test::Outcome bake = test::run_program({"bake", "--adaptation", "0.1", "--format", "clf", "-o", "-"});
  EXPECT_EQ(bake.exit_code, 5) << bake.err;
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(Hostile, marks_that_steer_text_are_escaped_in_messages) {
  for (const char* mark :
       {"\xe2\x80\xae", "\xe2\x80\xa8", "\xe2\x81\xa6", "\xe2\x80\x8b", "\xef\xbb\xbf", "\xd8\x9c"}) {
    const test::Outcome run =
        test::run_program({"explain", std::string("a") + mark + "b.exr", "--white-luminance", "1"});
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_EQ(run.err.find(mark), std::string::npos) << run.err;
  }
}

TEST(Hostile, configs_of_a_younger_opencolorio_are_told_from_damaged_ones) {
  if (OCIO_NAMESPACE::GetVersionHex() >= 0x02020000)
    GTEST_SKIP() << "OpenColorIO " << OCIO_NAMESPACE::GetVersion() << " reads them";
  test::write_flat_exr(test::place("in.exr"), {1, 1, 1});
  test::write_bytes(test::place("x.ocioz"), "PK");
  for (const std::string& config : {std::string("ocio://default"), test::place("x.ocioz")}) {
    const test::Run run = test::apply(test::place("in.exr"), test::place("out.exr"), {"--config", config});
    EXPECT_EQ(run.exit_code, 6);
    EXPECT_NE(run.err.find("needs OpenColorIO 2.2; this is"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace scotopic

// scotopic bake -o x.cube and check of it, as colourists run them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/run_program.h"
#include "looks/support.h"

namespace scotopic {
namespace {

using test::Outcome;
using test::run_program;

class BakeCube : public testing::Test {
 protected:
  std::string baked(const std::string& name, std::vector<std::string> options) {
    const std::string file = folder_.path(name);
    options.insert(options.begin(), "bake");
    options.insert(options.end(), {"-o", file});
    const Outcome outcome = run_program(options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    err_ = outcome.err;
    return file;
  }

  test::Folder folder_;
  std::string err_;
};

TEST_F(BakeCube, states_its_error_in_both_readings_and_check_finds_the_same) {
  const std::string file =
      baked("a.cube", {"--adaptation", "0.1", "--colorspace", "arri_logc4", "--size", "17"});
  const std::string text = test::read_text(file).substr(0, 4000);
  for (const char* line :
       {"\n# Rec.709 colours of -8 to 5 stops, tetrahedral: mean ",
        "\n# Rec.709 colours of -8 to 5 stops, trilinear: mean ",
        "\n# Colours of the space's own gamut (within AP1) of -8 to 5 stops, trilinear: mean ",
        "space=ARRI LogC4", "\nLUT_3D_SIZE 17\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  const Outcome checked = run_program({"check", file});
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  const std::string stated = text.substr(text.find("Rec.709 colours of -8 to 5 stops, trilinear"));
  EXPECT_NE(checked.out.find(stated.substr(0, stated.find('\n'))), std::string::npos) << checked.out << text;
}

TEST_F(BakeCube, takes_as_many_nodes_as_the_error_asks_for) {
  const std::string log = baked("log.cube", {"--adaptation", "0.1", "--colorspace", "ACEScct"});
  EXPECT_NE(test::read_text(log).find("LUT_3D_SIZE 33\n"), std::string::npos);
  EXPECT_EQ(err_.find("which is seen"), std::string::npos) << err_;
  // Dark codes of LogC4 lie close together: 33 nodes are few.
  const std::string dark = baked("dark.cube", {"--adaptation", "0.1", "--colorspace", "ARRI LogC4"});
  EXPECT_NE(test::read_text(dark).find("LUT_3D_SIZE 65\n"), std::string::npos);
}

TEST_F(BakeCube, warns_of_errors_that_are_seen) {
  baked("a.cube", {"--adaptation", "0.1", "--colorspace", "ARRI LogC4", "--size", "17"});
  EXPECT_NE(err_.find("which is seen"), std::string::npos) << err_;
  EXPECT_EQ(run_program({"bake", "--adaptation", "0.1", "--colorspace", "ARRI LogC4", "--size", "17",
                         "--max-error", "1", "-o", folder_.path("b.cube")})
                .exit_code,
            1);
}

TEST_F(BakeCube, of_a_display_gives_its_codes) {
  const std::string file = baked("n.cube", {"--adaptation", "0.1", "--colorspace", "ACEScct", "--size", "17",
                                            "--display", "night:Rec.1886 Rec.709 - Display"});
  const std::string text = test::read_text(file).substr(0, 4000);
  EXPECT_NE(text.find("# out: Rec.1886 Rec.709 - Display, peak 100 cd/m2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("the display stage, CIEDE2000 of what is shown"), std::string::npos) << text;
  EXPECT_NE(text.find("# Nodes lie between -0."), std::string::npos) << text;
  EXPECT_EQ(run_program({"check", file}).exit_code, 0);
  const std::string hdr = baked("h.cube", {"--adaptation", "0.1", "--colorspace", "ACEScct", "--size", "17",
                                           "--display", "night:Rec.2100-PQ - Display"});
  EXPECT_NE(test::read_text(hdr).find("peak 1000 cd/m2"), std::string::npos);
  EXPECT_NE(test::read_text(hdr).find("delta E ITP"), std::string::npos);
}

TEST_F(BakeCube, refuses_displays_where_they_make_no_sense) {
  const struct {
    std::vector<std::string> options;
    int code;
    const char* why;
  } rows[] = {
      {{"--display", "night"}, 2, "--colorspace"},
      {{"--colorspace", "ACEScct", "--display", "day"}, 2, "night:DISPLAY"},
      {{"--colorspace", "ACEScct", "--display", "night:sRGB - Displey"}, 6, "did you mean"},
      {{"--colorspace", "ACEScct", "--peak", "500"}, 2, "--display"},
      {{"--colorspace", "ACEScct", "--display", "night", "--peak", "x"}, 2, "--peak"},
  };
  for (const auto& row : rows) {
    std::vector<std::string> arguments = {"bake", "--adaptation", "0.1", "-o", folder_.path("x.clf")};
    arguments.insert(arguments.end(), row.options.begin(), row.options.end());
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, row.code) << outcome.err;
    EXPECT_NE(outcome.err.find(row.why), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace scotopic

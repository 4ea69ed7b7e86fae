// scotopic bake --shader as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli/run_program.h"
#include "color/primaries.h"
#include "looks/support.h"
#include "shaders/hosts.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_program;

class BakeShader : public testing::Test {
 protected:
  std::vector<std::string> bake(std::vector<std::string> more) const {
    more.insert(more.begin(), {"bake", "-o", folder_.path("x.shader")});
    return more;
  }

  test::Folder folder_;
};

TEST_F(BakeShader, what_makes_no_sense_is_refused_with_its_reason) {
  const struct {
    std::vector<std::string> arguments;
    int code;
    const char* why;
  } rows[] = {
      {{"--shader", "dctk"}, 2, "did you mean dctl?"},
      {{"--shader", "dctl", "--adaptation", "ladder"}, 2, "slider"},
      {{"--shader", "dctl", "--adaptation", "1", "--adaptation", "2"}, 2, "slider"},
      {{"--shader", "dctl", "--size", "65"}, 2, "--size is of LUTs"},
      {{"--shader", "dctl", "--format", "clf"}, 2, "--format is of LUTs"},
      {{"--shader", "dctl", "--max-error", "1"}, 2, "--max-error is of LUTs"},
      {{"--shader", "dctl", "--display", "sRGB"}, 2, "night:DISPLAY"},
      {{"--shader", "dctl", "--visibility", "ward1997"}, 2, "--display night"},
      {{"--shader", "dctl", "--display", "night", "--visibility", "ward"}, 2, "did you mean ward1997?"},
      {{"--shader", "dctl", "--colorspace", "ACEScct"}, 2, "not linear light"},
      {{"--shader", "dctl", "--effects", "acuity"}, 2, "acuity"},
      {{"--shader", "dctl", "--effects", "glare"}, 2, "glare"},
      {{"--adaptation", "1", "--visibility", "ward1997"}, 2, "--shader"},
      {{"--shader", "dctl", "--colorspace", "nowhere"}, 6, "nowhere"}};
  for (const auto& row : rows) {
    const Outcome outcome = run_program(bake(row.arguments));
    EXPECT_EQ(outcome.exit_code, row.code) << row.why << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(row.why), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(BakeShader, what_it_writes_is_the_operator_that_was_asked_for) {
  const Outcome outcome =
      run_program(bake({"--shader", "dctl", "--colorspace", "ACEScg", "--adaptation", "moon", "--model",
                        "kirk2011", "--strength-chroma", "0.5", "--display", "night:Display P3 - Display"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(
      outcome.err.find("takes and gives linear 'ACEScg', gives light of 'Display P3 - Display', linear"),
      std::string::npos)
      << outcome.err;
  ShaderSpec spec;
  spec.parameters.model = Model::kirk2011;
  spec.parameters.xyz_from_rgb = gamut_xyz_matrix("ap1").value();
  spec.parameters.xyz_from_gamut = spec.parameters.xyz_from_rgb;
  spec.display.emplace().xyz_from_rgb = spec.parameters.xyz_from_rgb;
  spec.display->xyz_from_display = gamut_xyz_matrix("p3").value();
  const auto shader = test::dctl_host("g++", test::read_text(folder_.path("x.shader")));
  const test::Worst worst = test::worst_of(spec, test::light(), [&](const auto& sliders, const auto& pixels) {
    return shader->show(sliders, pixels);
  });
  EXPECT_LE(worst.error, 2e-5) << worst.place;
}

TEST_F(BakeShader, says_the_same_twice) {
  for (const ShaderLanguageName& language : shader_languages) {
    const std::vector<std::string> arguments = bake({"--shader", std::string(language.name)});
    ASSERT_EQ(run_program(arguments).exit_code, 0);
    const std::string first = test::read_text(folder_.path("x.shader"));
    ASSERT_EQ(run_program(arguments).exit_code, 0);
    EXPECT_EQ(test::read_text(folder_.path("x.shader")), first) << language.name;
  }
}

}  // namespace
}  // namespace scotopic

// The program itself on spectral files: what it says, writes, and refuses.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/pixel_source.h"
#include "receptors/support.h"
#include "io/spectral/scene.h"

namespace scotopic {
namespace {

struct Outcome {
  int code;
  std::string text;  // stdout and stderr
};

Outcome run(const std::string& arguments) {
  std::FILE* pipe = popen((std::string(SCOTOPIC_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  std::string text;
  char part[4096];
  while (const std::size_t count = std::fread(part, 1, sizeof part, pipe)) text.append(part, count);
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text};
}

void write_chart(const std::string& file, const char* lamp, double cdm2, const char* prefix = "S0.") {
  const bool reflective = prefix[0] == 'T';
  const auto patches = test::reflectances("macbeth");
  test::TestImage image;
  image.width = 24;
  image.height = 3;
  image.parts = {test::band_channels(reflective ? patches : test::lit(patches, test::lamp(lamp), cdm2), 72,
                                     test::band_centres(380, 5, 780), 5,
                                     [&](double nm) { return prefix + test::stokes_name(nm).substr(3); })};
  image.text_attributes = {{"emissiveUnits", "W.m^-2.sr^-1.nm^-1"}, {"comments", "a chart"}};
  test::write_exr(file, image);
}

nlohmann::json explain(const std::string& arguments) {
  const Outcome outcome = run("explain --json -q " + arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  return nlohmann::json::parse(outcome.text);
}

// Mean signals of the chart under a lamp of so many cd/m2.
std::array<double, signal_count> chart_mean(const char* lamp, double cdm2) {
  std::array<double, signal_count> mean{};
  for (const auto& patch : test::lit(test::reflectances("macbeth"), test::lamp(lamp), cdm2))
    for (std::size_t s = 0; s < signal_count; ++s) mean[s] += test::true_signals(patch)[s] / 24;
  return mean;
}

TEST(SpectralProgram, explain_tells_the_same_of_spectra_and_of_their_lmsr) {
  const test::TemporaryFolder folder;
  test::WorstError spectral, receptors;
  for (const char* lamp : {"d65", "a", "moon", "hps", "led4000"}) {
    write_chart(folder / "chart.exr", lamp, 0.2);
    ASSERT_EQ(run("lmsr -q " + (folder / "chart.exr") + " -o " + (folder / "lmsr.exr")).code, 0);
    const auto truth = chart_mean(lamp, 0.2);
    const double photopic = truth[index(Signal::y)];
    const double scotopic = truth[index(Signal::rod)] * 1700.06 / 343.930088;
    for (const bool from_lmsr : {false, true}) {
      const nlohmann::json told = explain(folder / (from_lmsr ? "lmsr.exr" : "chart.exr"));
      test::WorstError& worst = from_lmsr ? receptors : spectral;
      // LMS tell luminance only as far as the cones span CIE 1931: within 2 %. S/P goes with it.
      const double share = from_lmsr ? 0.03 : 3e-3;
      worst.add(std::string(lamp) + " photopic", told["photopic"]["mean"], photopic, share * photopic);
      worst.add(std::string(lamp) + " scotopic", told["scotopic"]["mean"], scotopic, 3e-3 * scotopic);
      worst.add(std::string(lamp) + " S/P", told["spRatio"], scotopic / photopic,
                share * scotopic / photopic);
      EXPECT_GT(told["mesopicCoefficient"], 0.0);
      EXPECT_LT(told["mesopicCoefficient"], 1.0);
    }
  }
  spectral.expect_within("explain of spectra");
  receptors.expect_within("explain of their LMSR");
}

TEST(SpectralProgram, assumptions_are_said_with_v) {
  const test::TemporaryFolder folder;
  write_chart(folder / "chart.exr", "moon", 0.1);
  const Outcome outcome = run("explain -v " + (folder / "chart.exr"));
  for (const char* part : {"radiance per nm: emissiveUnits is",
                           "81 bands of radiance, 380 to 780 nm, taken as bins", "outside the bands lies L "})
    EXPECT_NE(outcome.text.find(part), std::string::npos) << part << " in " << outcome.text;
}

TEST(SpectralProgram, reflectance_takes_its_light_from_a_name_or_a_file) {
  const test::TemporaryFolder folder;
  write_chart(folder / "chart.exr", "", 0, "T.");
  {
    std::ofstream lamp(folder / "lamp.csv");
    lamp << "nm,power\n";
    for (int nm = 360; nm <= 830; ++nm)
      lamp << nm << "," << test::lamp("hps")[static_cast<std::size_t>(nm - 360)] << "\n";
  }
  const std::string chart = folder / "chart.exr --white-luminance 10 --illuminant ";
  const double named = explain(chart + "hps")["spRatio"];
  const double file = explain(chart + (folder / "lamp.csv"))["spRatio"];
  const double day = explain(chart + "d65")["spRatio"];
  EXPECT_NEAR(named, file, 2e-3 * named);
  EXPECT_GT(day, 3 * named);
  EXPECT_EQ(run("explain " + chart + "1.41").code, 2);
}

TEST(SpectralProgram, apply_takes_spectra_and_passes_on_what_is_not_a_band) {
  const test::TemporaryFolder folder;
  write_chart(folder / "chart.exr", "moon", 0.1);
  const Outcome outcome = run("apply " + (folder / "chart.exr") + " -o " + (folder / "seen.exr"));
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("spectral radiance is absolute"), std::string::npos) << outcome.text;
  const auto seen = open_source(folder / "seen.exr", Limits{});
  std::vector<std::string> names;
  for (const Channel& channel : seen->subimages()[0].channels) names.push_back(channel.name);
  EXPECT_EQ(names, (std::vector<std::string>{"B", "G", "R"}));
  bool comments = false;
  for (const Attribute& attribute : seen->attributes(0)) {
    EXPECT_NE(attribute.name, "emissiveUnits");
    comments |= attribute.name == "comments";
  }
  EXPECT_TRUE(comments);
}

TEST(SpectralProgram, wrong_input_ends_with_one_line_and_no_file) {
  const test::TemporaryFolder folder;
  write_chart(folder / "chart.exr", "moon", 0.1);
  const std::string chart = folder / "chart.exr", output = folder / "out.exr";
  test::TestImage bad;
  bad.width = bad.height = 2;
  bad.parts = {{{"S0.400.5nm", std::vector<float>(4, 1.0f)}, {"S0.500nm", std::vector<float>(4, 1.0f)}}};
  test::write_exr(folder / "bad.exr", bad);
  std::ofstream(folder / "lamp.csv") << "400,1\n300,1\n";
  struct Row {
    std::string arguments;
    int code;
    const char* text;
  };
  for (const Row& row :
       {Row{"lmsr " + (folder / "bad.exr") + " -o " + output, 3,
            "decimal point where the layout has a comma"},
        Row{"apply " + (folder / "bad.exr") + " -o " + output, 3, "decimal point where"},
        Row{"lmsr " + (folder / "none_%d.exr") + " -o " + output, 3, "no file has such a name"},
        Row{"lmsr " + chart + " -o " + (folder / "out.png"), 2, "OpenEXR only"},
        Row{"lmsr " + chart + " -o " + output + " --bands bins", 2, "did you mean"},
        Row{"lmsr " + chart + " -o " + output + " --band-radiance x", 2, "one of nm, band"},
        Row{"lmsr " + chart + " -o " + output + " --illuminant candle", 2, "a file with a spectrum"},
        Row{"lmsr " + chart + " -o " + output + " --illuminant " + (folder / "lamp.csv"), 3, "line 2"},
        Row{"lmsr " + chart + " -o " + output + " --receptor-channels a,b", 2, "four names"},
        Row{"lmsr " + chart + " -o " + output + " --receptor-channels a,b,c,d", 3, "has no channel \"a\""},
        Row{"lmsr " + chart + " -o " + output + " -d uint8", 2, "does not fit"},
        Row{"lmsr " + chart + " -o " + output + " --white-luminance 0", 2, "--white-luminance"}}) {
    const Outcome outcome = run(row.arguments);
    EXPECT_EQ(outcome.code, row.code) << row.arguments << ": " << outcome.text;
    EXPECT_NE(outcome.text.find(row.text), std::string::npos) << row.arguments << ": " << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(output)) << row.arguments;
  }
}

}  // namespace
}  // namespace scotopic

// Wrong input: exit code, one line, nothing written. One row a fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

struct Fault {
  std::vector<std::string> arguments;  ///< IN, OUT, TEXT, CUT, NONE, FOLDER stand for files of the test
  int exit_code;
  std::string says;
};

std::vector<std::string> apply(std::vector<std::string> more) {
  std::vector<std::string> out = {"apply", "IN", "-o", "OUT"};
  const bool has_adaptation = std::any_of(
      more.begin(), more.end(), [](const std::string& a) { return a.rfind("--adaptation", 0) == 0; });
  if (!has_adaptation) out.insert(out.end(), {"--adaptation", "1"});
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> rows = {
      {{"aply", "IN", "-o", "OUT"}, 2, "did you mean apply?"},
      {{"apply"}, 2, "input is required"},
      {{"apply", "IN"}, 2, "--output"},
      {{"apply", "IN", "-o", "OUT"}, 2, "absolute luminance unknown"},
      {{"apply", "NONE", "-o", "OUT", "--adaptation", "1"}, 3, "No such file"},
      {{"apply", "TEXT", "-o", "OUT", "--adaptation", "1"}, 3, "not an image"},
      {{"apply", "EMPTY", "-o", "OUT", "--adaptation", "1"}, 3, "is empty"},
      {{"apply", "CUT", "-o", "OUT", "--adaptation", "1", "-q"}, 3, "truncated"},
      {{"apply", "FOLDER", "-o", "OUT", "--adaptation", "1"}, 3, "folder"},
      {{"apply", "/dev/null", "-o", "OUT", "--adaptation", "1"}, 3, "not a regular file"},
      {{"apply", "IN", "-o", "FOLDER/none/out.exr", "--adaptation", "1"}, 5, "does not exist"},
      {{"apply", "IN", "-o", "FOLDER", "--adaptation", "1"}, 2, "must be named"},
      {{"apply", "IN", "-o", "out.gif", "--adaptation", "1"}, 2, "must be named"},
      {apply({"--adaptation", "0"}), 2, "'0' is not a luminance"},
      {apply({"--adaptation=-1"}), 2, "'-1' is not a luminance"},
      {apply({"--adaptation", "nan"}), 2, "'nan' is not a luminance"},
      {apply({"--adaptation", "inf"}), 2, "'inf' is not a luminance"},
      {apply({"--adaptation", "1e400"}), 2, "is not a luminance"},
      {apply({"--adaptation", "1,5"}), 2, "is not a luminance"},
      {apply({"--adaptation", ""}), 2, "is not a luminance"},
      {apply({"--adaptation"}), 2, "--adaptation"},
      {apply({"--adaptaton", "1"}), 2, "did you mean --adaptation?"},
      {apply({"--white-luminance", "0"}), 2, "'0' is not a luminance"},
      {apply({"--model", "kirk"}), 2, "did you mean kirk2011?"},
      {apply({"--effects", "shift,colour"}), 2, "'colour'"},
      {apply({"--effects", "shift,all"}), 2, "stand alone"},
      {apply({"--effects", ""}), 2, "--effects"},
      {apply({"--strength", "1.5"}), 2, "--strength: '1.5'"},
      {apply({"--strength=-0.1"}), 2, "--strength: '-0.1'"},
      {apply({"--strength-shift", "x"}), 2, "--strength-shift: 'x'"},
      {apply({"--strength-luminance", "nan"}), 2, "--strength-luminance: 'nan'"},
      {apply({"--strength-chroma", "2"}), 2, "--strength-chroma: '2'"},
      {apply({"--weight", "lokal"}), 2, "did you mean local?"},
      {apply({"--luminance", "scotopic"}), 2, "--luminance: 'scotopic'"},
      {apply({"--gamut", "rec79"}), 2, "did you mean rec709?"},
      {apply({"--illuminant", "monn"}), 2, "did you mean moon?"},
      {apply({"--illuminant=-2"}), 2, "--illuminant: '-2'"},
      {apply({"--rods", "cubic"}), 2, "--rods: 'cubic'"},
      {apply({"--exposure", "bright"}), 2, "--exposure: 'bright'"},
      {apply({"-d", "int8"}), 2, "did you mean uint8?"},
      {apply({"-d", "uint8"}), 2, "does not fit"},
      {apply({"--layer", "beauty"}), 2, "no layer or part 'beauty'"},
      {apply({"--threads", "-1"}), 2, "--threads"},
      {apply({"--colorspace", "ACESg"}), 6, "did you mean ACEScg?"},
      {apply({"--output-colorspace", "none such"}), 6, "unknown colour space 'none such'"},
      {apply({"--config", "NONE"}), 6, "No such file"},
      {apply({"--config", "TEXT"}), 6, "not a colour config"},
      {apply({"--max-pixels", "10"}), 4, "--max-pixels"},
      {apply({"--max-channels", "2"}), 4, "--max-channels"},
      {apply({"-v", "-q"}), 2, "--quiet"},
      {apply({"extra"}), 2, "extra"},
      {apply({"--safko-scale", "2"}), 2, "safko2019 alone"},
      {apply({"--model", "safko2019", "--safko-scale", "0"}), 2, "--safko-scale: '0'"},
      {apply({"--display", "Filmic"}), 6, "unknown view 'Filmic'"},
      {apply({"--display", "sRGB - Display/Un-tone-maped"}), 6, "did you mean"},
      {apply({"--display", "Un-tone-mapped", "--output-colorspace", "ACEScg"}), 2, "not both"},
      {apply({"--tone", "global"}), 2, "--tone: 'global'"},
      {apply({"--tone", "local", "--contrast", "0.5"}), 2, "--contrast: '0.5'"},
      {apply({"--contrast", "4"}), 2, "of the tone map: --tone local"},
      {apply({"--tone", "none", "--peak", "200"}), 2, "of the display stage"},
      {apply({"--display", "none", "--visibility", "ward1997"}), 2, "of the display stage: --display night"},
      {apply({"--display", "night", "--tone", "local"}), 2, "not both"},
      {apply({"--display", "night:no such", "--tone", "none"}), 6, "no display or colour space is called"},
      {apply({"--tone", "local", "--peak", "0"}), 2, "--peak: '0'"},
      {apply({"--tone", "local", "--night-range", "2"}), 2, "--night-range: '2'"},
      {apply({"--tone", "local", "--night-exponent", "nan"}), 2, "--night-exponent: 'nan'"},
      {apply({"--tone", "local", "--display-range", "3,1"}), 2, "--display-range: '3,1'"},
      {apply({"--tone", "local", "--display-range", "3"}), 2, "--display-range: '3'"},
      {apply({"--icc", "NONE"}), 6, "cannot be read"},
      {apply({"--icc", "TEXT"}), 6, "no ICC profile"},
      {apply({"--icc", "FOLDER"}), 6, "Is a directory"},
      {apply({"--icc", "TEXT", "--intent", "relativ"}), 2, "did you mean relative?"},
      {apply({"--icc", "TEXT", "--display", "Raw"}), 2, "not both"},
      {apply({"--intent", "relative"}), 2, "--icc, which is missing"},
      {apply({"--quality", "101"}), 2, "--quality: '101'"},
      {{"--adaptation"}, 2, "--adaptation"},
      {{"Apply", "IN", "-o", "OUT"}, 2, "did you mean apply?"},
      {{"", "IN"}, 2, "unknown verb ''"},
      {{"apply", "", "-o", "OUT", "--adaptation", "1"}, 3, "No such file"},
      {{"apply", "IN", "-o", "", "--adaptation", "1"}, 2, "--output: ''"},
      {{"apply", "IN", "-o"}, 2, "--output"},
      {{"apply", "IN", "-o", "OUT", "-o", "OUT", "--adaptation", "1"}, 2, "--output"},
      {{"apply", "IN", "-o", "/dev/null", "--adaptation", "1"}, 2, "must be named"},
      {{"apply", "IN", "-o", "IN/out.exr", "--adaptation", "1"}, 5, "does not exist"},
      {apply({"--adaptation", "1", "--adaptation", "2"}), 2, "--adaptation"},
      {apply({"--adaptation", "1e-10"}), 2, "'1e-10' is not a luminance"},
      {apply({"--adaptation", "2e9"}), 2, "'2e9' is not a luminance"},
      {apply({"--adaptation", "0x1p3"}), 2, "is not a luminance"},
      {apply({"--adaptation", "1 2"}), 2, "is not a luminance"},
      {apply({"--adaptation", "1nit"}), 2, "is not a luminance"},
      {apply({"--adaptation", "ladder"}), 2, "is not a luminance"},
      {apply({"--adaptation", "++1"}), 2, "is not a luminance"},
      {apply({"--adaptation", "auto:"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:mean"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:p0"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:p100"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:px"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:1,2,3"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:1,2,0,4"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:1,2,3,-4"}), 2, "auto:median"},
      {apply({"--adaptation", "auto:1.5,2,3,4"}), 2, "auto:median"},
      {apply({"--white-luminance", "nan"}), 2, "--white-luminance: 'nan'"},
      {apply({"--white-luminance=-5"}), 2, "--white-luminance: '-5'"},
      {apply({"--model", ""}), 2, "--model: ''"},
      {apply({"--model", "FILAMENT2021"}), 2, "--model: 'FILAMENT2021'"},
      {apply({"--effects", "shift,"}), 2, "--effects"},
      {apply({"--effects", ",shift"}), 2, "--effects"},
      {apply({"--effects", "none,chroma"}), 2, "stand alone"},
      {apply({"--effects", "auto,shift"}), 2, "stand alone"},
      {apply({"--strength", "50%"}), 2, "--strength: '50%'"},
      {apply({"--strength", "inf"}), 2, "--strength: 'inf'"},
      {apply({"--strength-acuity", "2"}), 2, "--strength-detail: '2'"},
      {apply({"--weight", ""}), 2, "--weight: ''"},
      {apply({"--luminance", "mesopik"}), 2, "did you mean mesopic?"},
      {apply({"--gamut", "srgb"}), 2, "--gamut: 'srgb'"},
      {apply({"--illuminant", "0"}), 2, "--illuminant: '0'"},
      {apply({"--illuminant", "nan"}), 2, "--illuminant: 'nan'"},
      {apply({"--illuminant", "TEXT"}), 3, "holds no spectrum"},
      {apply({"--illuminant", "EMPTY"}), 3, "no spectrum"},
      {apply({"--illuminant", "FOLDER"}), 3, "folder"},
      {apply({"--rods", ""}), 2, "--rods: ''"},
      {apply({"--exposure", "65"}), 2, "--exposure: '65'"},
      {apply({"--exposure", "nan"}), 2, "--exposure: 'nan'"},
      {apply({"--exposure", "1,5"}), 2, "--exposure: '1,5'"},
      {apply({"-d", "double"}), 2, "-d: 'double'"},
      {apply({"--precision", "lut34"}), 2, "did you mean lut33?"},
      {apply({"--precision", "half"}), 2, "--precision: 'half'"},
      {apply({"--max-error", "-1"}), 2, "--max-error"},
      {apply({"--max-error", "good"}), 2, "--max-error: 'good'"},
      {apply({"--budget", "fast"}), 2, "--budget: 'fast'"},
      {apply({"--precision", "double", "--max-error", "1"}), 2, "--precision"},
      {apply({"--nonfinite", "ignore"}), 2, "--nonfinite: 'ignore'"},
      {apply({"--bands", "bins"}), 2, "did you mean bin?"},
      {apply({"--band-radiance", "um"}), 2, "--band-radiance: 'um'"},
      {apply({"--receptor-channels", "L,M,S"}), 2, "four names"},
      {apply({"--receptor-channels", "L,M,S,Z"}), 3, "no channel"},
      {apply({"--adapt-white", "0.3"}), 2, "--adapt-white: '0.3'"},
      {apply({"--adapt-white", "0.6,0.5"}), 2, "--adapt-white: '0.6,0.5'"},
      {apply({"--adapt-white", "lamp", "--illuminant", "1.5"}), 2, "--adapt-white: 'lamp'"},
      {apply({"--adaptation-history", "moon"}), 2, "--adaptation-history: 'moon'"},
      {apply({"--acuity=blurred"}), 2, "--acuity: 'blurred'"},
      {apply({"--ppd", "0"}), 2, "--ppd: '0'"},
      {apply({"--ppd", "60", "--fov", "40"}), 2, "not both"},
      {apply({"--fov", "180"}), 2, "--fov: '180'"},
      {apply({"--acuity-space", "rgb"}), 2, "--acuity-space: 'rgb'"},
      {apply({"--acuity-range", "0"}), 2, "--acuity-range: '0'"},
      {apply({"--acuity-quality", "best"}), 2, "--acuity-quality: 'best'"},
      {apply({"--threads", "1.5"}), 2, "--threads"},
      {apply({"--threads", "2000"}), 2, "--threads"},
      {apply({"--threads", ""}), 2, "--threads"},
      {apply({"--max-side", "0"}), 2, "--max-side"},
      {apply({"--max-pixels", "-1"}), 2, "--max-pixels"},
      {apply({"--max-pixels", "1e30"}), 2, "--max-pixels"},
      {apply({"--max-channels", "many"}), 2, "--max-channels"},
      {apply({"--max-bands", "0"}), 2, "--max-bands"},
      {apply({"--max-memory", "x"}), 2, "--max-memory"},
      {apply({"--max-memory", "100"}), 4, "exceeds the limit of 100 (raise it with --max-memory)"},
      {apply({"--max-side", "63"}), 4, "side 64 exceeds the limit of 63 (raise it with --max-side)"},
      {apply({"--max-lut-size", "0"}), 2, "--max-lut-size"},
      {apply({"--max-config-size", "nan"}), 2, "--max-config-size"},
      {apply({"--config", "TEXT", "--max-config-size", "3"}), 4, "--max-config-size"},
      {apply({"--config", "FOLDER"}), 6, "folder"},
      {apply({"--config", "EMPTY"}), 6, "not a colour config"},
      {apply({"--output-colorspace", "sRGB - Dispaly"}), 6, "did you mean sRGB - Display?"},
      {apply({"--json", "-v", "--model"}), 2, "--model"},
      {apply({"--verbos"}), 2, "did you mean --verbose?"},
      {apply({"-z"}), 2, "-z"},
      {apply({"--", "--adaptation"}), 2, "--adaptation"},
      {{"lmsr", "IN"}, 2, "--output"},
      {{"lmsr", "IN", "-o", "out.png"}, 2, "OpenEXR only"},
      {{"lmsr", "NONE", "-o", "OUT"}, 3, "No such file"},
      {{"lmsr", "IN", "-o", "OUT", "-d", "uint8"}, 2, "does not fit"},
      {{"lmsr", "IN", "-o", "OUT", "--precision", "half"}, 2, "--precision: 'half'"},
      {{"lmsr", "IN", "-o", "OUT", "--white-luminance", "0"}, 2, "--white-luminance: '0'"},
      {{"lmsr", "IN", "-o", "OUT", "--rods", "x"}, 2, "--rods: 'x'"},
      {{"lmsr", "IN", "-o", "OUT", "--illuminant", "monn"}, 2, "did you mean moon?"},
      {{"lmsr", "IN", "-o", "OUT", "--adaptation", "1"}, 2, "unknown option '--adaptation'"},
      {{"explain"}, 2, "IN is required"},
      {{"explain", "NONE"}, 3, "No such file"},
      {{"explain", "TEXT"}, 3, "not an image"},
      {{"explain", "IN"}, 2, "absolute luminance unknown"},
      {{"explain", "IN", "--adaptation", "1", "--csv", "--json"}, 2, "--csv excludes --json"},
      {{"explain", "none.ocio"}, 6, "No such file"},
      {{"bake"}, 2, "give one of"},
      {{"bake", "-o", "OUT", "--adaptation", "1"}, 2, "no LUT format"},
      {{"bake", "-o", "out.clf"}, 2, "--adaptation is needed"},
      {{"bake", "-o", "out.clf", "--adaptation", "1", "--size", "34"}, 2, "did you mean 33?"},
      {{"bake", "-o", "out.clf", "--adaptation", "1", "--format", "3dl"}, 2, "--format: '3dl'"},
      {{"bake", "-o", "FOLDER/none/out.clf", "--adaptation", "1"}, 5, "does not exist"},
      {{"bake", "-o", "FOLDER", "--format", "clf", "--adaptation", "1"}, 5, "folder"},
      {{"bake", "--config", "TEXT", "--adaptation", "1"}, 5, "not a folder"},
      {{"bake", "--config", "FOLDER", "--luts", "TEXT", "--adaptation", "1"}, 5, "not a folder"},
      {{"bake", "--into", "NONE", "--adaptation", "1"}, 6, "No such file"},
      {{"bake", "--into", "TEXT", "--adaptation", "1"}, 6, "not a colour config"},
      {{"bake", "--config", "FOLDER", "--into", "TEXT", "--adaptation", "1"}, 2, "give one of"},
      {{"bake", "--config", "FOLDER", "--adaptation", "1", "--beside", "kirk"}, 2, "did you mean kirk2011?"},
      {{"bake", "--config", "FOLDER", "--adaptation", "1", "--colorspace", "ACEScct"}, 2, "linear light"},
      {{"check"}, 2, "is required"},
      {{"check", "NONE"}, 3, "No such file"},
      {{"check", "FOLDER"}, 3, "folder"},
      {{"check", "TEXT"}, 6, "no LUT that says"},
      {{"check", "TEXT", "look"}, 2, "no looks to choose from"},
      {{"check", "none.ocio"}, 6, "No such file"},
      {{"check", "TEXT", "--max-error", "x"}, 2, "--max-error: 'x'"},
      {{"time", "--rounds", "0"}, 2, "--rounds: '0'"},
      {{"time", "--pixels", "12"}, 2, "--pixels: '12'"},
      {{"time", "--pixels", "268435456"}, 4, "--max-memory"},
      {{"time", "NONE", "--adaptation", "1"}, 3, "No such file"},
      {{"time", "--csv", "--json"}, 2, "--csv"},
  };
  return rows;
}

bool asks_for_json(const Fault& fault) {
  return std::count(fault.arguments.begin(), fault.arguments.end(), "--json") > 0;
}

class Faults : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::work_folder();
    test::write_picture(folder_ + "/IN", 64, 64);
    std::ofstream(folder_ + "/TEXT") << "hello, night\n";
    std::ofstream(folder_ + "/EMPTY").flush();
    fs::copy_file(folder_ + "/IN", folder_ + "/CUT");
    fs::resize_file(folder_ + "/CUT", fs::file_size(folder_ + "/CUT") * 2 / 3);
    fs::create_directory(folder_ + "/FOLDER");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> placed(std::vector<std::string> arguments) const {
    for (std::string& a : arguments) {
      if (a == "OUT") a = "OUT.exr";
      for (const char* name :
           {"IN", "OUT.exr", "TEXT", "EMPTY", "CUT", "NONE", "FOLDER", "FOLDER/none/out.exr", "out.gif",
            "out.png", "out.clf", "FOLDER/none/out.clf", "IN/out.exr", "none.ocio"})
        if (a == name) {
          a = folder_ + "/" + a;
          break;
        }
    }
    return arguments;
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder_), {}));
  }

  std::string folder_;
};

TEST_F(Faults, each_ends_with_its_code_one_line_and_nothing_written) {
  const std::size_t before = entries();
  for (const Fault& fault : faults()) {
    std::string command;
    for (const std::string& a : fault.arguments) command += " " + a;
    const test::Outcome outcome = test::run_program(placed(fault.arguments));
    EXPECT_EQ(outcome.exit_code, fault.exit_code) << command << "\n" << outcome.err;
    if (asks_for_json(fault)) continue;  // json_says_the_same
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("scotopic: ", 0), 0u) << command << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(fault.says), std::string::npos) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << command;
    EXPECT_EQ(entries(), before) << command;
  }
}

TEST_F(Faults, there_are_more_than_150) { EXPECT_GE(faults().size(), 150u); }

TEST_F(Faults, json_says_the_same) {
  for (const Fault& fault : faults()) {
    if (fault.arguments.empty() || fault.arguments[0] == "time") continue;  // --csv excludes --json
    std::vector<std::string> arguments = placed(fault.arguments);
    arguments.insert(arguments.begin() + 1, "--json");
    const test::Outcome outcome = test::run_program(arguments);
    EXPECT_EQ(outcome.exit_code, fault.exit_code) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const nlohmann::json said = nlohmann::json::parse(outcome.err, nullptr, false);
    ASSERT_TRUE(said.contains("error")) << outcome.err;
    EXPECT_EQ(said["error"]["code"], fault.exit_code);
    EXPECT_EQ(said["error"]["filesWritten"], 0);
    const std::string message =
        said["error"]["file"].get<std::string>() + ": " + said["error"]["message"].get<std::string>();
    EXPECT_NE(message.find(fault.says), std::string::npos) << message;
  }
}

TEST_F(Faults, a_line_break_in_a_name_stays_within_the_line) {
  const test::Outcome outcome =
      test::run_program({"apply", "no\nsuch\x1b[31m", "-o", folder_ + "/OUT.exr", "--adaptation", "1"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_NE(outcome.err.find("no\\nsuch\\x1b"), std::string::npos) << outcome.err;
}

TEST(Help, every_verb_has_one_with_an_example) {
  const test::Outcome all = test::run_program({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  for (const std::string verb : {"apply", "lmsr", "explain", "bake", "check", "time"}) {
    EXPECT_NE(all.out.find("\n  " + verb + " "), std::string::npos) << verb;
    const test::Outcome outcome = test::run_program({verb, "--help"});
    EXPECT_EQ(outcome.exit_code, 0) << verb;
    EXPECT_NE(outcome.out.find("Example"), std::string::npos) << verb;
    EXPECT_NE(outcome.out.find("scotopic " + verb + " "), outcome.out.rfind("scotopic " + verb + " "))
        << verb << ": usage alone";
  }
  EXPECT_EQ(test::run_program({"--version"}).out.rfind("scotopic ", 0), 0u);
}

TEST(Arguments, the_program_by_itself_prints_its_verbs_and_papers_names_are_understood) {
  const test::Outcome alone = test::run_program({});
  EXPECT_EQ(alone.exit_code, 2);
  for (const char* verb : {"apply", "lmsr", "explain", "bake", "check", "time"})
    EXPECT_NE(alone.out.find(verb), std::string::npos) << verb;
  const test::Outcome la = test::run_program({"apply", "in.exr", "-o", "out.exr", "--la", "0.1"});
  EXPECT_EQ(la.exit_code, 2);
  EXPECT_NE(la.err.find("unknown option '--la'; did you mean --adaptation?"), std::string::npos) << la.err;
}

}  // namespace
}  // namespace scotopic

// Wrong input: exit code, one line, nothing written. One row a fault.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

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
      {{}, 2, ""},
      {{"aply", "IN", "-o", "OUT"}, 2, "did you mean apply?"},
      {{"apply"}, 2, ""},
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
      {apply({"--config", "NONE"}), 6, "not a colour config"},
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
      {apply({"--contrast", "4"}), 2, "of the tone map"},
      {apply({"--tone", "none", "--peak", "200"}), 2, "of the tone map"},
      {apply({"--tone", "local", "--peak", "0"}), 2, "--peak: '0'"},
      {apply({"--tone", "local", "--night-range", "2"}), 2, "--night-range: '2'"},
      {apply({"--tone", "local", "--night-exponent", "nan"}), 2, "--night-exponent: 'nan'"},
      {apply({"--tone", "local", "--display-range", "3,1"}), 2, "--display-range: '3,1'"},
      {apply({"--tone", "local", "--display-range", "3"}), 2, "--display-range: '3'"},
      {apply({"--icc", "NONE"}), 6, "cannot be read"},
      {apply({"--icc", "TEXT"}), 6, "no ICC profile"},
      {apply({"--icc", "FOLDER"}), 6, ""},
      {apply({"--icc", "TEXT", "--intent", "relativ"}), 2, "did you mean relative?"},
      {apply({"--icc", "TEXT", "--display", "Raw"}), 2, "not both"},
      {apply({"--intent", "relative"}), 2, "--icc, which is missing"},
      {apply({"--quality", "101"}), 2, "--quality: '101'"},
  };
  return rows;
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
           {"IN", "OUT.exr", "TEXT", "EMPTY", "CUT", "NONE", "FOLDER", "FOLDER/none/out.exr", "out.gif"})
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
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("scotopic: ", 0), 0u) << command << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(fault.says), std::string::npos) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << command;
    EXPECT_EQ(entries(), before) << command;
  }
}

TEST_F(Faults, json_says_the_same) {
  const test::Outcome outcome = test::run_program(placed(apply({"--json", "--model", "x"})));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err.rfind("{\"error\":{\"code\":2,", 0), 0u) << outcome.err;
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
  const test::Outcome outcome = test::run_program({"apply", "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("Example: scotopic apply"), std::string::npos);
  EXPECT_EQ(test::run_program({"--version"}).out.rfind("scotopic ", 0), 0u);
}

}  // namespace
}  // namespace scotopic

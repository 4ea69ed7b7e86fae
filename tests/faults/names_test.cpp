// Names that shells, formats and terminals stumble over are names like others.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "faults/inputs.h"
#include "faults/rig.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> hostile_names() {
  std::vector<std::string> names = {"with space",
                                    " leading",
                                    "trailing ",
                                    "it's",
                                    "say \"night\"",
                                    "back\\slash",
                                    "new\nline",
                                    "-leading",
                                    "--help",
                                    "%d",
                                    "%s%n",
                                    "100%",
                                    "$(reboot)",
                                    "`reboot`",
                                    "$HOME",
                                    "*",
                                    "?",
                                    "[a-z]",
                                    "a;b",
                                    "a&b",
                                    "a|b",
                                    "<a>",
                                    "~",
                                    "#",
                                    "\xff\xfe\x80",
                                    "\x1b[31m",
                                    "\xc2\x9b"
                                    "31m",
                                    "\xf0\x9f\x8c\x99",
                                    "tab\there",
                                    "{0}",
                                    "...",
                                    ".hidden",
                                    "a=b",
                                    ":",
                                    "name.exr",
                                    "\xe2\x80\xae"};
  names.push_back(std::string(251, 'n'));
  return names;
}

class Names : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = work_folder("names");
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  /// Runs in the folder, so that a name can begin with -.
  Ended in_folder(std::vector<std::string> arguments) const {
    Attempt run_it;
    run_it.arguments = std::move(arguments);
    const fs::path here = fs::current_path();
    fs::current_path(folder_);
    const Ended ended = run(run_it);
    fs::current_path(here);
    return ended;
  }
  std::string folder_;
};

TEST_F(Names, any_name_can_be_read_and_written) {
  Attempt plain;
  plain.arguments = {"apply", input("in.exr"), "-o", folder_ + "/plain.exr", "--adaptation", "0.1", "-q"};
  ASSERT_EQ(run(plain).exit_code, 0);
  const std::string expected = files_in(folder_).at("plain.exr");
  long wrong = 0;
  for (const std::string& name : hostile_names()) {
    const std::string in = name, out = name.substr(0, 240) + "out.exr";
    fs::copy_file(input("in.exr"), folder_ + "/" + in, fs::copy_options::overwrite_existing);
    // After -- nothing is an option; an option's own value is joined to it where it begins with a dash.
    const Ended ended = in_folder({"apply", "--output=" + out, "--adaptation", "0.1", "-q", "--", in});
    const Files now = files_in(folder_);
    const bool good = ended.exit_code == 0 && ended.err.empty() && now.size() == 3 && now.count(out) &&
                      now.at(out) == expected;
    wrong += !good;
    EXPECT_TRUE(good) << name << ": " << ended.exit_code << " " << ended.err;
    fs::remove(folder_ + "/" + in);
    fs::remove(folder_ + "/" + out);
  }
  tally("hostile names, read and written", static_cast<long>(hostile_names().size()),
        "exit 0, the same bytes",
        wrong == 0 ? "exit 0 (" + std::to_string(hostile_names().size()) + ")"
                   : "WRONG " + std::to_string(wrong));
}

TEST_F(Names, any_name_is_said_in_one_line_of_plain_characters) {
  long wrong = 0;
  for (const std::string& name : hostile_names())
    for (const bool json : {false, true}) {
      std::vector<std::string> arguments = {"apply", "--output=out.exr", "--adaptation", "0.1", "--", name};
      if (json) arguments.insert(arguments.begin() + 1, "--json");
      const Ended ended = in_folder(arguments);
      std::string broken = broken_report(ended, {3});
      for (const char c : ended.err)
        if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f) broken = "control characters";
      if (!fs::is_empty(folder_)) broken = "litter";
      wrong += !broken.empty();
      EXPECT_EQ(broken, "") << name;
    }
  tally("hostile names that are not there", 2 * static_cast<long>(hostile_names().size()),
        "exit 3, one line without control characters",
        wrong == 0 ? "exit 3 (" + std::to_string(2 * hostile_names().size()) + ")"
                   : "WRONG " + std::to_string(wrong));
}

TEST_F(Names, a_name_too_long_is_known_before_the_work) {
  fs::copy_file(input("in.exr"), folder_ + "/in.exr");
  const Ended ended =
      in_folder({"apply", "in.exr", "-o", std::string(252, 'n') + ".exr", "--adaptation", "0.1"});
  EXPECT_EQ(broken_report(ended, {5}), "");
  EXPECT_NE(ended.err.find("File name too long"), std::string::npos) << ended.err;
}

TEST_F(Names, luts_and_configs_may_be_called_anything) {
  for (const std::string& name : {std::string("moon light $(x) %d"), std::string("-m'\"\n")}) {
    const Ended lut =
        in_folder({"bake", "--adaptation", "0.1", "--size", "17", "-q", "--output=" + name + ".clf"});
    EXPECT_EQ(lut.exit_code, 0) << lut.err;
    EXPECT_TRUE(fs::exists(folder_ + "/" + name + ".clf"));
    const Ended config = in_folder({"bake", "--adaptation", "0.1", "--size", "17", "-q", "--config=" + name});
    EXPECT_EQ(config.exit_code, 0) << config.err;
    EXPECT_TRUE(fs::exists(folder_ + "/" + name + "/config.ocio"));
  }
}

TEST_F(Names, devices_folders_pipes_and_links) {
  fs::copy_file(input("in.exr"), folder_ + "/in.exr");
  fs::create_directory(folder_ + "/dir.exr");
  ASSERT_EQ(mkfifo((folder_ + "/pipe.exr").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", folder_ + "/null.exr");
  fs::create_symlink("nowhere.exr", folder_ + "/dangling.exr");
  fs::create_symlink("loop.exr", folder_ + "/loop.exr");
  const Files before = files_in(folder_ + "/dir.exr");
  for (const char* out : {"dir.exr", "pipe.exr", "null.exr", "loop.exr", "in.exr/out.exr"}) {
    const Ended ended = in_folder({"apply", "in.exr", "-o", out, "--adaptation", "0.1"});
    EXPECT_EQ(broken_report(ended, {5}), "") << out;
  }
  EXPECT_TRUE(fs::is_symlink(folder_ + "/null.exr") && fs::is_fifo(folder_ + "/pipe.exr"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  // A pipe as input would hold us for ever.
  for (const char* in : {"dir.exr", "pipe.exr", "null.exr", "loop.exr", "dangling.exr"}) {
    const Ended ended = in_folder({"apply", in, "-o", "out.exr", "--adaptation", "0.1"});
    EXPECT_EQ(broken_report(ended, {3}), "") << in;
  }
  for (const char* config : {"dir.exr", "pipe.exr", "null.exr", "/dev/zero"}) {
    EXPECT_EQ(
        broken_report(
            in_folder({"apply", "in.exr", "-o", "out.exr", "--adaptation", "1", "--config", config}), {6}),
        "");
    EXPECT_EQ(broken_report(in_folder({"check", config}), {3}), "");
    EXPECT_EQ(broken_report(in_folder({"apply", "in.exr", "-o", "out.exr", "--adaptation", "1",
                                       "--illuminant", config}),
                            {3}),
              "");
  }
  // A link whose target is not there yet stays one.
  const Ended ended = in_folder({"apply", "in.exr", "-o", "dangling.exr", "--adaptation", "0.1", "-q"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(fs::is_symlink(folder_ + "/dangling.exr") && fs::is_regular_file(folder_ + "/nowhere.exr"));
}

}  // namespace
}  // namespace scotopic::test

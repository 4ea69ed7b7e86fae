// scotopic bake --into and --config as their users run them, on files that are there already.
#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>

#include "cli/run_program.h"
#include "looks/merge/configs.h"
#include "looks/support.h"

extern char** environ;

namespace scotopic {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::run_program;

Outcome bake(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"bake", "--size", "17"});
  return run_program(arguments);
}

/// Fails with this code and one line that says why.
void expect_refused(const Outcome& outcome, int code, const std::string& why) {
  EXPECT_EQ(outcome.exit_code, code) << outcome.err;
  EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

int files_in(const std::string& folder) {
  return static_cast<int>(
      std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator()));
}

class Into : public testing::Test {
 protected:
  test::Folder folder_;
};

TEST_F(Into, of_two_programs_at_once_one_waits_and_no_look_is_lost) {
  for (int round = 0; round < 3; ++round) {
    const std::string name = "round" + std::to_string(round),
                      config = folder_.write(name + "/config.ocio", test::studio);
    std::vector<pid_t> children;
    for (const char* la : {"0.1", "0.01", "0.001"}) {
      std::vector<std::string> words = {SCOTOPIC_PROGRAM, "bake", "-q",     "--size", "17",
                                        "--adaptation",   la,     "--into", config};
      std::vector<char*> argv;
      for (std::string& word : words) argv.push_back(word.data());
      argv.push_back(nullptr);
      children.emplace_back();
      ASSERT_EQ(posix_spawn(&children.back(), SCOTOPIC_PROGRAM, nullptr, nullptr, argv.data(), environ), 0);
    }
    for (const pid_t child : children) {
      int status = 0;
      waitpid(child, &status, 0);
      EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    }
    const Outcome checked = run_program({"check", config});
    EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
    for (const char* look : {"Mesopic 0.1 nit", "Mesopic 0.01 nit", "Mesopic 0.001 nit"})
      EXPECT_NE(checked.out.find(look), std::string::npos) << checked.out;
    EXPECT_EQ(test::read_text(config + ".before_scotopic"), test::studio);
  }
}

TEST_F(Into, one_after_the_other_both_stand_in_manifest) {
  const std::string config = folder_.write("config.ocio", test::aces);
  ASSERT_EQ(bake({"-q", "--adaptation", "0.1", "--into", config}).exit_code, 0);
  ASSERT_EQ(bake({"-q", "--adaptation", "0.01", "--into", config}).exit_code, 0);
  const Outcome checked = run_program({"check", config});
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  const std::string manifest = test::read_text(folder_.path("scotopic/MANIFEST"));
  EXPECT_EQ(std::count(manifest.begin(), manifest.end(), '\n'), 8) << manifest;
}

TEST_F(Into, a_lut_of_another_config_is_not_replaced_without_force) {
  const std::string one = folder_.write("a/config.ocio", test::aces),
                    two = folder_.write("b/config.ocio", test::studio);
  fs::create_directories(folder_.path("b/luts"));
  ASSERT_EQ(bake({"-q", "--adaptation", "0.1", "--into", one}).exit_code, 0);
  fs::copy(folder_.path("a/scotopic"), folder_.path("b/luts/scotopic"));
  const std::string before = test::read_text(two);
  expect_refused(bake({"-q", "--adaptation", "0.1", "--into", two}), 5, "--force");
  EXPECT_EQ(test::read_text(two), before);
  EXPECT_EQ(bake({"-q", "--adaptation", "0.1", "--into", two, "--force"}).exit_code, 0);
  EXPECT_EQ(run_program({"check", two}).exit_code, 0);
}

TEST_F(Into, an_archive_is_refused_in_words) {
  const std::string archive = folder_.write("x.ocioz", std::string("PK\3\4") + std::string(100, 'x'));
  const std::string before = test::read_text(archive);
  expect_refused(bake({"--adaptation", "0.1", "--into", archive}), 6, "ocioarchive");
  const std::string renamed = folder_.write("x.ocio", before);
  expect_refused(bake({"--adaptation", "0.1", "--into", renamed}), 6, "archive");
  EXPECT_EQ(test::read_text(archive), before);
  expect_refused(bake({"--adaptation", "0.1", "--into", "ocio://default"}), 6, "built into OpenColorIO");
}

TEST_F(Into, a_config_of_a_younger_profile_is_refused_by_its_version) {
  std::string text = test::aces;
  text.replace(text.find("2.1"), 3, "2.99");
  expect_refused(bake({"--adaptation", "0.1", "--into", folder_.write("config.ocio", text)}), 6,
                 "config.ocio: needs OpenColorIO 2.99; this is 2.");
}

TEST_F(Into, what_scene_linear_is_can_be_said_where_the_config_does_not) {
  const std::string config = folder_.write("config.ocio", test::no_interchange);
  const std::vector<std::string> add = {"-q", "--adaptation", "0.1", "--into", config};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), add.begin(), add.end());
    return bake(more);
  };
  expect_refused(bake(add), 6, "--working-primaries");
  expect_refused(with({"--working-primaries", "rec708"}), 2, "rec709, rec2020");
  for (const char* text : {"0.64 0.33 0.3 0.6 0.15 0.06 0.3127", "a b c d e f g h", "1 2 3 4 5 6 7 0"})
    expect_refused(with({"--working-primaries", folder_.write("p.txt", text)}), 2, "eight numbers");
  // Sony's S-Gamut3, which no name stands for.
  ASSERT_EQ(with({"--working-primaries",
                  folder_.write("p.txt", "0.73 0.28\n0.14 0.855\n0.1 -0.05\n0.3127 0.329\n")})
                .exit_code,
            0);
  expect_refused(run_program({"check", config}), 6, "--working-primaries");
  EXPECT_EQ(run_program({"check", config, "--working-primaries", folder_.path("p.txt")}).exit_code, 0);
  EXPECT_EQ(run_program({"check", config, "--working-primaries", "rec709"}).exit_code, 1);
  const std::string aces = folder_.write("aces.ocio", test::aces);
  expect_refused(bake({"--adaptation", "0.1", "--into", aces, "--working-primaries", "rec709"}), 6,
                 "its own roles");
  EXPECT_EQ(bake({"-q", "--adaptation", "0.1", "--into", aces, "--working-primaries", "ap1", "--dry-run"})
                .exit_code,
            0);
}

TEST_F(Into, a_dry_run_writes_nothing_and_refuses_what_the_run_would) {
  const std::string config = folder_.write("config.ocio", test::aces);
  const Outcome shown = bake({"--adaptation", "0.1", "--into", config, "--dry-run"});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_NE(shown.out.find("+search_path: ."), std::string::npos) << shown.out;
  EXPECT_EQ(files_in(folder_.path()), 1);
}

class NewConfig : public Into {};

TEST_F(NewConfig, a_config_of_someone_else_is_not_replaced) {
  const std::string config = folder_.write("config.ocio", test::studio);
  expect_refused(bake({"-q", "--adaptation", "0.1", "--new-config", folder_.path()}), 5, "--force");
  EXPECT_EQ(test::read_text(config), test::studio);
  EXPECT_EQ(files_in(folder_.path()), 1);
}

TEST_F(NewConfig, by_force_it_stays_beside_under_a_name_of_its_own) {
  const std::string config = folder_.write("config.ocio", test::studio);
  folder_.write("config.ocio.before_scotopic", "older");
  ASSERT_EQ(bake({"-q", "--adaptation", "0.1", "--config", folder_.path(), "--force"}).exit_code, 0);
  EXPECT_EQ(test::read_text(config + ".before_scotopic"), "older");
  EXPECT_EQ(test::read_text(config + ".before_scotopic_2"), test::studio);
  EXPECT_EQ(run_program({"check", config}).exit_code, 0);
}

TEST_F(NewConfig, its_own_is_replaced_until_somebody_has_worked_on_it) {
  const std::vector<std::string> again = {"-q", "--adaptation", "0.1", "--config", folder_.path()};
  ASSERT_EQ(bake(again).exit_code, 0);
  ASSERT_EQ(bake(again).exit_code, 0);
  const std::string text = test::read_text(folder_.path("config.ocio"));
  folder_.write("config.ocio", text + "# ours now\n");
  expect_refused(bake(again), 5, "config.ocio");
  folder_.write("config.ocio", text);
  folder_.write("luts/MANIFEST", "of a ship");
  expect_refused(bake(again), 5, "MANIFEST");
}

TEST_F(NewConfig, searches_the_folder_of_its_luts_alone_wherever_that_is) {
  const struct {
    const char *config, *luts, *search_path;
  } rows[] = {{"a", nullptr, "luts"},
              {"b", "b_luts", "../b_luts"},
              {"c/config", "c/luts", "luts:../luts"},
              {"d", "d/x/y", "x/y"}};
  for (const auto& row : rows) {
    std::vector<std::string> arguments = {"-q", "--adaptation", "0.1", "--config", folder_.path(row.config)};
    if (row.luts) arguments.insert(arguments.end(), {"--luts", folder_.path(row.luts)});
    ASSERT_EQ(bake(arguments).exit_code, 0);
    const std::string file = folder_.path(std::string(row.config) + "/config.ocio");
    EXPECT_STREQ(OCIO_NAMESPACE::Config::CreateFromFile(file.c_str())->getSearchPath(), row.search_path);
    EXPECT_EQ(run_program({"check", file}).exit_code, 0) << row.config;
  }
}

}  // namespace
}  // namespace scotopic

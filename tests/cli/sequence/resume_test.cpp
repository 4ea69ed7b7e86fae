// --skip-existing leaves what this command made of these inputs, and nothing else.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "cli/sequence/sequence.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

class Resume : public test::Sequence {
 protected:
  using Statuses = std::map<int, std::string>;
  Statuses again(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"--frames", "1-4", "--skip-existing"};
    const bool adapted = std::find(more.begin(), more.end(), "--adaptation") != more.end();
    if (!adapted) arguments.insert(arguments.end(), {"--adaptation", "0.1"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return statuses(applied(arguments));
  }
  static Statuses all(const std::string& status) {
    return {{1, status}, {2, status}, {3, status}, {4, status}};
  }
};

TEST_F(Resume, the_same_command_finds_everything_done_whatever_changes_no_pixel) {
  write_frames(4, 1.5);
  EXPECT_EQ(again(), all("written"));
  const auto time = fs::last_write_time(path("seen.0002.exr"));
  EXPECT_EQ(again(), all("skipped"));
  EXPECT_EQ(again({"--threads", "3", "--frames-at-once", "1", "--continue-on-error"}), all("skipped"));
  EXPECT_EQ(fs::last_write_time(path("seen.0002.exr")), time);
  // A sequence is stamped without --skip-existing, too.
  EXPECT_EQ(statuses(applied({"--frames", "1-4", "--adaptation", "0.1"})), all("written"));
  EXPECT_EQ(again(), all("skipped"));
}

TEST_F(Resume, any_other_option_computes_anew) {
  write_frames(4);
  EXPECT_EQ(again(), all("written"));
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--adaptation", "0.1000001"},
                                             {"--strength", "0.99"},
                                             {"--effects", "shift"},
                                             {"--exposure", "1"},
                                             {"-d", "float"},
                                             {"--precision", "double"},
                                             {"--nonfinite", "clean"},
                                             {"--illuminant", "a"},
                                             {"--ppd", "60"}}) {
    EXPECT_EQ(again(more), all("written")) << more[0];
    EXPECT_EQ(again(more), all("skipped")) << more[0];
    EXPECT_EQ(again(), all("written")) << "back from " << more[0];
  }
}

TEST_F(Resume, a_changed_input_is_computed_anew_and_a_touched_one_is_not) {
  write_frames(4);
  EXPECT_EQ(again(), all("written"));
  const auto time = fs::last_write_time(path("in.0002.exr"));
  // Other values under the time that it had.
  test::write_scaled_picture(path("in.0002.exr"), 48, 40, 1.25);
  fs::last_write_time(path("in.0002.exr"), time);
  fs::last_write_time(path("in.0003.exr"), time + std::chrono::hours(1));
  EXPECT_EQ(again(), (Statuses{{1, "skipped"}, {2, "written"}, {3, "skipped"}, {4, "skipped"}}));
}

TEST_F(Resume, outputs_that_are_gone_damaged_or_of_other_making_are_computed_anew) {
  write_frames(4);
  EXPECT_EQ(again(), all("written"));
  const std::string whole = bytes("seen.0001.exr");
  fs::remove(path("seen.0001.exr"));
  EXPECT_EQ(again()[1], "written");
  EXPECT_EQ(bytes("seen.0001.exr"), whole);
  for (const std::size_t cut : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write("seen.0001.exr", whole.substr(0, cut));
    EXPECT_EQ(again(), (Statuses{{1, "written"}, {2, "skipped"}, {3, "skipped"}, {4, "skipped"}})) << cut;
    EXPECT_EQ(bytes("seen.0001.exr"), whole);
  }
  write("seen.0001.exr", bytes("in.0001.exr"));
  EXPECT_EQ(again()[1], "written");
  write("seen.0001.exr", bytes("seen.0002.exr"));  // a frame under another's name
  EXPECT_EQ(again()[1], "written");
}

TEST_F(Resume, files_that_options_name_count_by_what_they_hold) {
  write_frames(4);
  write("lamp.txt", "380 1\n780 1\n");
  const std::vector<std::string> lamp = {"--illuminant", path("lamp.txt")};
  EXPECT_EQ(again(lamp), all("written"));
  EXPECT_EQ(again(lamp), all("skipped"));
  write("lamp.txt", "380 1\n780 2\n");
  EXPECT_EQ(again(lamp), all("written"));
}

TEST_F(Resume, pictures_of_other_formats_carry_the_provenance_too) {
  write_frames(2);
  for (const char* format : {"png", "tif"}) {
    const std::vector<std::string> command = {"apply",
                                              "{}/in.####.exr",
                                              "-o",
                                              std::string("{}/seen.####.") + format,
                                              "--frames",
                                              "1-2",
                                              "--adaptation",
                                              "0.1",
                                              "--skip-existing",
                                              "--json",
                                              "-q"};
    EXPECT_EQ(nlohmann::json::parse(run(command).out)["written"], 2) << format;
    EXPECT_EQ(nlohmann::json::parse(run(command).out)["skipped"], 2) << format;
  }
}

TEST_F(Resume, after_kill_9_only_what_is_missing_is_computed) {
  constexpr int frames = 24;
  write_frames(frames, 1.05, 256, 256);
  const std::vector<std::string> command = {"--frames", "1-24", "--adaptation", "0.1", "--skip-existing"};
  ASSERT_EQ(apply(command).exit_code, 0);
  std::map<int, std::string> expected;
  const auto name = [](int f) {
    char text[32];
    std::snprintf(text, sizeof text, "seen.%04d.exr", f);
    return std::string(text);
  };
  for (int f = 1; f <= frames; ++f) expected[f] = bytes(name(f));

  std::size_t recomputed = 0, found = 0;
  for (const std::size_t kill_after : {1u, 5u, 9u, 14u, 20u}) {
    for (int f = 1; f <= frames; ++f) fs::remove(path(name(f)));
    const pid_t child = fork();
    if (child == 0) {
      const int nothing = open("/dev/null", O_WRONLY);
      dup2(nothing, STDERR_FILENO);
      const std::string in = path("in.####.exr"), out = path("seen.####.exr");
      execl(SCOTOPIC_PROGRAM, SCOTOPIC_PROGRAM, "apply", in.c_str(), "-o", out.c_str(), "--white-luminance",
            "1", "--frames", "1-24", "--adaptation", "0.1", "--skip-existing", "--threads", "1",
            static_cast<char*>(nullptr));
      _exit(127);
    }
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (files("seen") < kill_after && std::chrono::steady_clock::now() < patience)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    const std::size_t there = files("seen");
    ASSERT_GE(there, kill_after);

    const nlohmann::json result = applied(command);
    EXPECT_EQ(result["skipped"], there);
    EXPECT_EQ(result["written"], frames - there);
    for (int f = 1; f <= frames; ++f) EXPECT_EQ(bytes(name(f)), expected[f]) << f;
    found += there;
    recomputed += frames - there;
  }
  std::printf(
      "killed 5 times in 24 frames: %zu frames found and left, %zu computed, all of the bytes they have "
      "undisturbed\n",
      found, recomputed);
  EXPECT_GT(recomputed, 0u);
}

}  // namespace
}  // namespace scotopic

// How far it is: a bar on a terminal, lines in a log.
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "cli/sequence/sequence.h"

namespace scotopic {
namespace {

class ProgressOf : public test::Sequence {
 protected:
  /// What the program writes to a terminal that wide.
  std::string on_terminal(std::vector<std::string> words, unsigned short columns) const {
    words.insert(words.begin(), SCOTOPIC_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    winsize size = {24, columns, 0, 0};
    int master = -1;
    const pid_t child = forkpty(&master, nullptr, nullptr, &size);
    if (child == 0) {
      unsetenv("OCIO");
      execv(SCOTOPIC_PROGRAM, argv.data());
      _exit(127);
    }
    std::string text;
    char block[4096];
    for (;;) {
      const ssize_t n = read(master, block, sizeof block);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;  // EIO: the other end is closed
      text.append(block, static_cast<std::size_t>(n));
    }
    int status = 0;
    waitpid(child, &status, 0);
    close(master);
    EXPECT_EQ(status, 0);
    return text;
  }
};

TEST_F(ProgressOf, a_sequence_is_a_bar_with_rate_and_time_to_go_and_leaves_no_trace) {
  write_frames(1, 1, 1500, 1500);
  for (int f = 2; f <= 6; ++f) write("in.000" + std::to_string(f) + ".exr", bytes("in.0001.exr"));
  const std::vector<std::string> command = {"apply",
                                            path("in.####.exr"),
                                            "-o",
                                            path("seen.####.exr"),
                                            "--frames",
                                            "1-6",
                                            "--adaptation",
                                            "0.1",
                                            "--white-luminance",
                                            "1",
                                            "--threads",
                                            "1",
                                            "--frames-at-once",
                                            "1",
                                            "--acuity",
                                            "--ppd",
                                            "240"};
  const std::string text = on_terminal(command, 100);
  EXPECT_NE(text.find("["), std::string::npos) << text;
  EXPECT_NE(text.find(" of 6 frames, "), std::string::npos) << text;
  EXPECT_NE(text.find(" to go"), std::string::npos) << text;
  EXPECT_EQ(text.find("0001.exr: written"), std::string::npos) << text;  // the bar says it
  EXPECT_NE(text.find("6 of 6 frames written"), std::string::npos) << text;
  // What is drawn fits the line: the terminal never scrolls under it.
  for (std::size_t at = text.find("\rscotopic: ["); at != text.npos; at = text.find("\rscotopic: [", at + 1))
    EXPECT_LT(text.find('\r', at + 1) - at, 101u);
  std::vector<std::string> shorter = command;
  *std::find(shorter.begin(), shorter.end(), "1-6") = "1-3";
  const std::string narrow = on_terminal(shorter, 30);
  EXPECT_EQ(narrow.find("["), std::string::npos) << narrow;
  shorter.push_back("-q");
  EXPECT_EQ(on_terminal(shorter, 100), "");
}

TEST_F(ProgressOf, a_single_big_picture_has_its_bar_too) {
  write_frames(1, 1, 2500, 2500);
  const std::string text =
      on_terminal({"apply", path("in.0001.exr"), "-o", path("seen.exr"), "--adaptation", "0.1",
                   "--white-luminance", "1", "--acuity", "--ppd", "240", "--threads", "1"},
                  100);
  EXPECT_NE(text.find(" of 2500 rows"), std::string::npos) << text;
}

}  // namespace
}  // namespace scotopic

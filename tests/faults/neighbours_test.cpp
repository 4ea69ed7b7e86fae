// The same faults, and what the neighbours do: no test of ours, but what docs/faults.md puts beside it. Long
// form only.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "faults/inputs.h"
#include "faults/rig.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

struct Neighbour {
  std::string name, program;
  std::vector<std::string> arguments;  ///< @ stands for the folder
  std::string output;
};

const std::string shipped_config = std::string(SCOTOPIC_SOURCE_DIR) + "/ocio_config/config.ocio";

std::vector<Neighbour> neighbours() {
  return {
      {"oiiotool", "/usr/bin/oiiotool", {"@/in.exr", "-o", "@/out.exr"}, "out.exr"},
      {"oiiotool (TIFF)", "/usr/bin/oiiotool", {"@/in.exr", "-o", "@/out.tif"}, "out.tif"},
      {"ocioconvert", "/usr/bin/ocioconvert", {"@/in.exr", "ACEScg", "@/out.exr", "ACES2065-1"}, "out.exr"},
      {"scotopic apply",
       SCOTOPIC_PROGRAM,
       {"apply", "@/in.exr", "-o", "@/out.exr", "--adaptation", "0.1", "-q"},
       "out.exr"},
      {"scotopic bake",
       SCOTOPIC_PROGRAM,
       {"bake", "--adaptation", "0.1", "--colorspace", "ACEScct", "--size", "17", "-o", "@/out.cube", "-q"},
       "out.cube"},
      {"ociobakelut",
       "/usr/bin/ociobakelut",
       {"--iconfig", shipped_config, "--inputspace", "ACEScct", "--outputspace", "sRGB - Display", "--format",
        "iridas_cube", "--cubesize", "17", "@/out.cube"},
       "out.cube"}};
}

struct Counted {
  long tries = 0, lost = 0, lied = 0, crashed = 0, kept = 0, whole = 0;
};

class Neighbours : public ::testing::TestWithParam<Neighbour> {
 protected:
  void SetUp() override {
    if (!long_form()) GTEST_SKIP() << "only in the long form (SCOTOPIC_FAULTS=long)";
    if (access(GetParam().program.c_str(), X_OK) != 0)
      GTEST_SKIP() << GetParam().program << " is not installed";
    folder_ = work_folder("neighbour");
    reset();
    Attempt clean = run_of();
    clean.call = "event", clean.action = "5", clean.at = 0;
    const Ended ended = run(clean);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    calls_ = ended.calls;
    seconds_ = ended.seconds;
    whole_ = files_in(folder_).at(GetParam().output);
  }
  void reset() const {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy_file(input("big.exr"), folder_ + "/in.exr");
    std::ofstream(folder_ + "/" + GetParam().output) << "old";
  }
  Attempt run_of() const {
    Attempt out;
    out.program = GetParam().program;
    out.arguments = GetParam().arguments;
    for (std::string& a : out.arguments)
      if (a.rfind("@/", 0) == 0) a = folder_ + a.substr(1);
    out.folder = folder_;
    out.environment = {"OCIO=" + shipped_config};
    return out;
  }
  void count(const Attempt& faulty, Counted& out) const {
    reset();
    const Ended ended = run(faulty);
    const Files now = files_in(folder_);
    const auto file = now.find(GetParam().output);
    // Metadata may hold the time: of the same length is as good as the same.
    const bool whole = file != now.end() && file->second.size() == whole_.size();
    const bool old = file != now.end() && file->second == "old";
    ++out.tries;
    out.kept += old;
    out.whole += whole;
    out.lost += !whole && !old;
    out.lied += !whole && ended.exit_code == 0;
    out.crashed += ended.exit_code == 134 || ended.exit_code == 139;
  }
  /// A disk that is full after a share of the file; the system's own stdio buffers lie between, so this is
  /// done by a limit on the file's size.
  Counted full_disk() const {
    Counted out;
    for (int i = 0; i < 50; ++i) {
      Attempt faulty = run_of();
      faulty.file_size = 1 + static_cast<long>(whole_.size()) * i / 50;
      faulty.no_size_signal = true;
      count(faulty, out);
    }
    return out;
  }
  Counted at_random(int signal) const {
    Counted out;
    for (int i = 0; i < 100; ++i) {
      Attempt faulty = run_of();
      faulty.kill_signal = signal;
      faulty.kill_after = seconds_ * (i + 0.5) / 100;
      count(faulty, out);
    }
    return out;
  }
  Counted no_memory() const {
    Counted out;
    const long calls = calls_.at("malloc");
    for (int i = 0; i < 100; ++i) {
      Attempt faulty = run_of();
      faulty.call = "malloc", faulty.action = std::to_string(ENOMEM), faulty.at = 1 + calls * i / 100;
      count(faulty, out);
    }
    return out;
  }
  void say(const std::string& fault, const Counted& c) const {
    tally(GetParam().name + ": " + fault, c.tries, "-",
          c.tries == 0
              ? "no such call"
              : "old file kept " + std::to_string(c.kept) + ", whole new file " + std::to_string(c.whole) +
                    ", neither " + std::to_string(c.lost) + "; exit 0 without a whole file " +
                    std::to_string(c.lied) + "; crashed " + std::to_string(c.crashed));
  }

  std::string folder_, whole_;
  std::map<std::string, long> calls_;
  double seconds_ = 0;
};

TEST_P(Neighbours, do_so) {
  say("disk full after a share of the file", full_disk());
  say("kill -9 at a random instant", at_random(SIGKILL));
  say("SIGTERM at a random instant", at_random(SIGTERM));
  say("the k-th allocation fails", no_memory());
}

INSTANTIATE_TEST_SUITE_P(All, Neighbours, ::testing::ValuesIn(neighbours()),
                         [](const auto& it) { return "n" + std::to_string(it.index); });

}  // namespace
}  // namespace scotopic::test

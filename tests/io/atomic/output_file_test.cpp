#include "io/atomic/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "io/atomic/output_set.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ("scotopic-" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static std::string read(const std::string& file) {
    std::ostringstream out;
    out << std::ifstream(file, std::ios::binary).rdbuf();
    return out.str();
  }
  static void write(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  int entries() const { return static_cast<int>(std::distance(fs::directory_iterator(folder_), {})); }

  fs::path folder_;
};

TEST_F(OutputFileTest, nothing_is_there_before_commit_and_all_of_it_after) {
  OutputFile file(path("new"));
  file.write("scotopic", 8);
  EXPECT_FALSE(fs::exists(path("new")));
  file.commit();
  EXPECT_EQ(read(path("new")), "scotopic");
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, without_commit_the_old_file_stays_and_no_litter) {
  write(path("old"), "old");
  {
    OutputFile file(path("old"));
    file.write("new", 3);
  }
  EXPECT_EQ(read(path("old")), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, replaces_an_old_file_and_keeps_its_mode) {
  write(path("old"), "old");
  chmod(path("old").c_str(), 0640);
  OutputFile file(path("old"));
  file.write("new", 3);
  EXPECT_EQ(read(path("old")), "old");
  file.commit();
  EXPECT_EQ(read(path("old")), "new");
  EXPECT_EQ(fs::status(path("old")).permissions(), fs::perms(0640));
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, a_link_is_followed_not_replaced) {
  write(path("target"), "old");
  fs::create_symlink("target", path("link"));
  OutputFile file(path("link"));
  file.write("new", 3);
  file.commit();
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read(path("target")), "new");
}

TEST_F(OutputFileTest, writes_overlap_and_come_back_as_a_file_would) {
  // Positions within, across and beyond the buffer of 1 MiB.
  const std::string big(3 << 20, 'x');
  OutputFile file(path("seek"));
  file.write(big.data(), big.size());
  file.seek(5);
  file.write("abc", 3);
  file.seek((1 << 20) - 1);
  file.write("de", 2);
  char back[3] = {};
  file.seek(5);
  EXPECT_EQ(file.read(back, 3), 3u);
  EXPECT_EQ(std::string(back, 3), "abc");
  file.seek(4 << 20);
  file.write("end", 3);
  file.commit();
  std::string expected = big;
  expected.replace(5, 3, "abc").replace((1 << 20) - 1, 2, "de");
  expected.resize(4 << 20, '\0');
  EXPECT_EQ(read(path("seek")), expected + "end");
}

TEST_F(OutputFileTest, folders_devices_and_missing_folders_are_refused) {
  fs::create_directory(path("folder"));
  for (const std::string& target : {path("folder"), std::string("/dev/null"), path("none/file")}) {
    try {
      OutputFile file(target);
      ADD_FAILURE() << target << " was accepted";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::output) << target;
    }
  }
}

TEST_F(OutputFileTest, a_link_to_nothing_yet_is_followed_too) {
  fs::create_directory(path("sub"));
  fs::create_symlink("sub/target", path("link"));
  OutputFile file(path("link"));
  file.write("new", 3);
  file.commit();
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(read(path("sub/target")), "new");
}

TEST_F(OutputFileTest, completed_is_not_yet_in_place) {
  write(path("old"), "old");
  OutputFile file(path("old"));
  file.write("new", 3);
  file.complete();
  EXPECT_EQ(read(path("old")), "old");
  EXPECT_EQ(read(file.open_name()), "new");
  const int before = files_in_place();
  file.publish();
  EXPECT_EQ(read(path("old")), "new");
  EXPECT_EQ(files_in_place(), before + 1);
}

TEST_F(OutputFileTest, what_cannot_take_its_place_goes_away) {
  write(path("old"), "old");
  OutputFile file(path("old"));
  file.write("new", 3);
  fs::remove(path("old"));
  fs::create_directory(path("old"));  // which no rename replaces
  EXPECT_THROW(file.commit(), Error);
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, an_abandoned_temporary_goes_and_a_living_one_stays) {
  // Its name is the same for each writer of the target (FNV-1a of the name).
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : std::string("target")) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  char hexadecimal[17];
  std::snprintf(hexadecimal, sizeof hexadecimal, "%016llx", static_cast<unsigned long long>(hash));
  const std::string name = path(std::string(".scotopic-") + hexadecimal + "-0.tmp");
  write(name, "of a program that was killed");
  { OutputFile file(path("target")); }
  EXPECT_FALSE(fs::exists(name));
  write(name, "of a program that lives");
  const int living = open(name.c_str(), O_RDWR);
  ASSERT_EQ(flock(living, LOCK_EX), 0);
  {
    write(path("target"), "old");
    OutputFile file(path("target"));
    file.write("new", 3);
    file.commit();
  }
  EXPECT_TRUE(fs::exists(name));
  EXPECT_EQ(read(path("target")), "new");
  close(living);
}

TEST_F(OutputFileTest, a_set_is_in_place_only_when_all_of_it_is_written) {
  write(path("a"), "old a");
  {
    OutputSet set;
    set.make_folder(path("new/sub"));
    set.add(path("a"), "new a");
    set.add(path("new/sub/b"), "new b");
    EXPECT_EQ(read(path("a")), "old a");
  }
  EXPECT_EQ(read(path("a")), "old a");
  EXPECT_FALSE(fs::exists(path("new")));
  OutputSet set;
  set.make_folder(path("new/sub/"));
  set.add(path("a"), "new a");
  set.add(path("new/sub/b"), "new b");
  set.commit();
  EXPECT_EQ(read(path("a")), "new a");
  EXPECT_EQ(read(path("new/sub/b")), "new b");
}

TEST_F(OutputFileTest, folders_that_can_be_written_to_are_known_before) {
  EXPECT_NO_THROW(require_writable_folder(path("not/there/yet")));
  EXPECT_NO_THROW(require_writable_folder(folder_.string()));
  write(path("file"), "");
  EXPECT_THROW(require_writable_folder(path("file")), Error);
  EXPECT_THROW(require_writable_folder(path("file/sub")), Error);
}

TEST_F(OutputFileTest, a_full_disk_is_an_error_and_leaves_nothing) {
  // A limit on file sizes stands for a disk without room: write() fails half-way.
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = 4096;
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  ExitCode code = ExitCode::done;
  try {
    OutputFile file(path("big"));
    const std::string big(2 << 20, 'x');
    file.write(big.data(), big.size());
    file.commit();
  } catch (const Error& e) {
    code = e.code();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(code, ExitCode::output);
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace scotopic

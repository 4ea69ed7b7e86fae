// What goes wrong with what is read: broken disks, files cut short or changed meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>

#include "faults/inputs.h"
#include "faults/sweep.h"
#include "base/error.h"
#include "io/pixel_source.h"
#include "io/pixels/row_bands.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

TEST(Reading, a_broken_disk_is_an_error) {
  Seen seen;
  const Fault fault = {"EIO at the k-th read", "read", std::to_string(EIO), true, {0, 3, 5, 6}};
  for (const char* name : {"apply exr", "apply tiff pages", "lmsr"})
    sweep(subject_of(verb(name)), fault, long_form() ? 1000 : 30, seen);
  if (long_form()) sweep(subject_of(verb("bake into")), fault, 20, seen);
  tally(fault.name, seen.tries, "exit 3 (5: reading back what was written, 6: config), the old file",
        text_of(seen));
}

TEST(Reading, parts_and_interruptions_change_nothing) {
  Seen seen;
  // Not of TIFF: libtiff takes part of a read for the end of the file (docs/faults.md).
  for (const char* name : {"apply exr", "lmsr"}) {
    const Subject subject = subject_of(verb(name));
    sweep(subject, {"", "read", "short", true, {0}}, 1, seen);
    sweep(subject, {"", "read", std::to_string(EINTR), false, {0}}, long_form() ? 1000 : 10, seen);
  }
  tally("reads of half, and EINTR at the k-th read", seen.tries, "exit 0, the same bytes", text_of(seen));
}

/// The input is changed at the k-th read of it.
void changed(const std::string& how, const std::vector<int>& codes, const std::string& expected) {
  const std::string folder = work_folder("changed");
  const std::string in = folder + "/in.exr", out = folder + "/out.exr";
  Attempt changing;
  changing.arguments = {"apply", in, "-o", out, "--adaptation", "0.1", "-q", "--threads", "2"};
  changing.folder = in, changing.call = "read", changing.action = "5", changing.at = 0;
  const auto reset = [&] {
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::copy_file(input("big.exr"), in);
    fs::copy_file(input("in.exr"), in + ".other");
  };
  reset();
  const long reads = run(changing).calls["read"];
  const std::string whole = files_in(folder).at("out.exr");
  ASSERT_GT(reads, 4);
  Seen seen;
  const long tries = std::min(reads, long_form() ? 300l : 20l);
  for (long i = 0; i < tries; ++i) {
    reset();
    changing.action = how;
    changing.at = 1 + i * (reads - 1) / tries;
    const Ended ended = run(changing);
    ++seen.tries, ++seen.codes[ended.exit_code];
    Files now = files_in(folder);
    std::string wrong = broken_report(ended, codes);
    // Done is only what was made of one state of the file.
    if (wrong.empty() && ended.exit_code == 0 && how != "replace" && now.at("out.exr") != whole)
      wrong = "made of two states";
    if (wrong.empty() && ended.exit_code != 0 && now.count("out.exr")) wrong = "wrote";
    for (const auto& [name, text] : now)
      if (name != "in.exr" && name != "in.exr.other" && name != "out.exr") wrong = "litter: " + name;
    seen.wrong += !wrong.empty();
    EXPECT_EQ(wrong, "") << how << " at read " << changing.at << " of " << reads;
  }
  tally("the input is changed while it is read: " + how, seen.tries, expected, text_of(seen));
}

TEST(Reading, a_file_changed_meanwhile_is_no_picture) {
  changed("truncate", {3}, "exit 3, nothing written");
  // Before the first look at it, that is the file.
  changed("append", {0, 3}, "exit 3, nothing written; 0 where it was before the first look");
  changed("rewrite", {3}, "exit 3, nothing written");
  changed("replace", {0, 3}, "exit 0 from one file, or 3");
}

/// All pixels of a file, through the readers.
void read_all(const std::string& file) {
  const auto source = open_source(file, Limits{});
  Band band;
  for (std::size_t i = 0; i < source->subimages().size(); ++i)
    each_band(source->subimages()[i], false, [&](int y0, int rows) { source->read(i, y0, rows, band); });
}

TEST(Reading, a_file_cut_at_any_byte_is_refused) {
  const std::string folder = work_folder("cut");
  for (const char* name : {"in.exr", "spectral.exr"}) {
    const std::string file = folder + "/" + name;
    const auto size = fs::file_size(input(name));
    long wrong = 0;
    for (std::uintmax_t bytes = 0; bytes < size; ++bytes) {
      fs::copy_file(input(name), file, fs::copy_options::overwrite_existing);
      fs::resize_file(file, bytes);
      try {
        read_all(file);
        ++wrong;
        ADD_FAILURE() << name << " of " << bytes << " of " << size << " bytes was taken";
      } catch (const Error& e) {
        const bool good = e.code() == ExitCode::input && e.file() == file && !std::string(e.what()).empty();
        wrong += !good;
        EXPECT_TRUE(good) << bytes << ": " << e.what();
      }
    }
    tally(std::string(name) + " cut after every byte", static_cast<long>(size), "refused as input (3)",
          wrong == 0 ? "3 (" + std::to_string(size) + ")" : "WRONG " + std::to_string(wrong));
  }
}

TEST(Reading, the_program_refuses_cut_files_and_leaves_nothing) {
  const std::string folder = work_folder("cut-program");
  const auto size = fs::file_size(input("in.exr"));
  const long step = long_form() ? 1 : static_cast<long>(size / 25);
  Seen seen;
  for (long bytes = 0; bytes < static_cast<long>(size); bytes += step) {
    fs::copy_file(input("in.exr"), folder + "/cut.exr", fs::copy_options::overwrite_existing);
    fs::resize_file(folder + "/cut.exr", static_cast<std::uintmax_t>(bytes));
    Attempt cut;
    cut.arguments = {"apply", folder + "/cut.exr", "-o", folder + "/out.exr", "--adaptation", "0.1", "-q"};
    const Ended ended = run(cut);
    ++seen.tries, ++seen.codes[ended.exit_code];
    std::string wrong = broken_report(ended, {3});
    if (wrong.empty() && files_in(folder).size() != 1) wrong = "litter";
    seen.wrong += !wrong.empty();
    EXPECT_EQ(wrong, "") << bytes;
  }
  tally("apply on an EXR cut short", seen.tries, "exit 3, nothing written", text_of(seen));
}

}  // namespace
}  // namespace scotopic::test

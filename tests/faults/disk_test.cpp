// What goes wrong with the disk: each call of each kind in its turn, for every verb that writes.
#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>

#include "faults/sweep.h"

namespace scotopic::test {
namespace {

/// Every verb, prepared once for all tests of this program.
const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> out;
    for (const WritingVerb& verb : writing_verbs()) out.push_back(subject_of(verb));
    return out;
  }();
  return all;
}

/// Slow verbs get fewer tries in the short form.
long most(const Subject& subject, long quick, long slow) {
  return long_form() ? 100000 : subject.verb->slow ? slow : quick;
}

void sweep_all(const Fault& fault, const std::string& expected, long quick = 12, long slow = 2) {
  Seen seen;
  for (const Subject& subject : subjects()) sweep(subject, fault, most(subject, quick, slow), seen);
  tally(fault.name, seen.tries, expected, text_of(seen));
  EXPECT_GT(seen.tries, 0);
}

const std::string old_file = "exit 5, the old files";
std::string number(int n) { return std::to_string(n); }

TEST(Disk, full_at_every_write) {
  sweep_all({"disk full (ENOSPC) from the k-th write on", "write", number(ENOSPC), true, {5}}, old_file);
}

TEST(Disk, full_once) {
  sweep_all({"disk full at the k-th write only", "write", number(ENOSPC), false, {5}}, old_file, 8, 1);
}

TEST(Disk, broken_at_every_write) {
  sweep_all({"EIO at the k-th write", "write", number(EIO), false, {5}}, old_file, 8, 1);
}

TEST(Disk, writes_of_half_are_gone_on_with) {
  sweep_all({"every write does but half", "write", "short", true, {0}}, "exit 0, the new files", 1, 1);
}

TEST(Disk, interrupted_writes_are_repeated) {
  sweep_all({"EINTR at the k-th write", "write", number(EINTR), false, {0}}, "exit 0, the new files", 8, 1);
}

TEST(Disk, not_synced_is_not_done) {
  // The last is of the folder, when the new file is in place: that is said, too.
  sweep_all({"fsync fails (EIO) from the k-th on", "fsync", number(EIO), true, {5}},
            "exit 5, each file old or new (new where the folder cannot be synced)", 2, 1);
}

TEST(Disk, a_file_that_cannot_be_closed_is_not_done) {
  sweep_all({"the k-th close fails (EIO)", "close", number(EIO), false, {0, 3, 5, 6}},
            "exit 5, the old files; 0 where nothing can be lost", 8, 1);
}

TEST(Disk, no_file_can_be_made) {
  sweep_all({"read-only file system (EROFS)", "create", number(EROFS), true, {5}}, old_file, 2, 1);
  sweep_all({"folder not writable (EACCES)", "create", number(EACCES), true, {5}}, old_file, 2, 1);
  sweep_all({"no quota for the k-th file (EDQUOT)", "create", number(EDQUOT), true, {5}}, old_file, 2, 2);
}

TEST(Disk, a_file_system_without_nameless_files_does_too) {
  // The first attempt is O_TMPFILE: then a hidden temporary is made.
  sweep_all({"no O_TMPFILE (EOPNOTSUPP) at the k-th file", "create", number(EOPNOTSUPP), false, {0, 5}},
            "exit 0, the new files", 3, 2);
}

TEST(Disk, no_name_can_be_given) {
  sweep_all({"link fails (EIO)", "link", number(EIO), true, {5}}, old_file, 2, 2);
}

TEST(Disk, no_name_can_be_changed) {
  sweep_all({"the k-th rename fails (EIO)", "rename", number(EIO), false, {5}},
            "exit 5, each file old or new", 4, 3);
}

TEST(Disk, no_folder_can_be_made) {
  sweep_all({"mkdir fails (ENOSPC)", "mkdir", number(ENOSPC), false, {5}}, old_file, 2, 2);
}

TEST(Disk, killed_before_every_change) {
  sweep_all({"kill -9 before the k-th change to the disk", "event", "kill", false, {137}, true},
            "each file old or new; the next run does its work", 20, 2);
}

TEST(Disk, told_to_end_at_every_change) {
  for (const auto& [name, signal] :
       {std::pair{"SIGTERM", SIGTERM}, {"SIGINT", SIGINT}, {"SIGHUP", SIGHUP}, {"SIGPIPE", SIGPIPE}})
    sweep_all({std::string(name) + " at the k-th change to the disk",
               "event",
               "signal" + number(signal),
               false,
               {128 + signal, 0}},
              "exit 128+n, each file old or new, nothing else", signal == SIGTERM ? 12 : 4, 1);
}

}  // namespace
}  // namespace scotopic::test

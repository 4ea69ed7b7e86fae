// What goes wrong with the process: memory, descriptors, limits, signals, a second program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <random>

#include "faults/inputs.h"
#include "faults/sweep.h"

namespace scotopic::test {
namespace {

TEST(Memory, the_kth_allocation_fails) {
  if (!long_form()) GTEST_SKIP() << "NOTICE: only in the long form (scripts/faults.sh)";
  for (const bool on : {false, true}) {
    Fault fault = {on ? "no memory from the k-th allocation on" : "the k-th allocation fails",
                   "malloc",
                   std::to_string(ENOMEM),
                   on,
                   {0, 3, 4, 5, 6, 70}};
    Seen seen;
    for (const char* name : {"apply exr", "lmsr"}) sweep(subject_of(verb(name)), fault, 500, seen);
    sweep(subject_of(verb("bake clf")), fault, 200, seen);
    tally(fault.name, seen.tries, "one line, old or new, no crash", text_of(seen));
    // Some of the libraries that OpenImageIO brings end or crash the program where memory ends while they are
    // loaded.
    fault.loads_libraries = true;
    Seen tiff;
    sweep(subject_of(verb("apply tiff")), fault, 500, tiff);
    tally(fault.name + ", TIFF", tiff.tries, "each file old or new", text_of(tiff));
  }
}

/// The least address space, in steps of 8 MiB, in which the program starts: below, the system cannot load its
/// libraries, or these end it before main() does anything. One step more, as both are not exact.
long least_address_space() {
  long mib = 32;
  for (;; mib += 8) {
    Attempt version;
    version.arguments = {"--version"};
    version.address_space = mib << 20;
    if (run(version).exit_code == 0) return mib + 8;
    if (mib > 400) throw std::runtime_error("the program does not start in 400 MiB");
  }
}

TEST(Memory, an_address_space_of_any_size_will_do_or_is_said_to_be_too_small) {
  const long least = least_address_space();
  for (const char* name : {"apply exr", "apply tiff"}) {
    const Subject subject = subject_of(verb(name));
    Seen seen;
    const int steps = long_form() ? 200 : 20;
    for (int i = 0; i < steps; ++i) {
      Attempt run_with;
      run_with.arguments = arguments_of(*subject.verb, subject.folder);
      run_with.address_space = (least + (800 - least) * i / steps) << 20;
      subject.reset();
      const Ended ended = run(run_with);
      ++seen.tries, ++seen.codes[ended.exit_code];
      std::string wrong = broken_promise(files_in(subject.folder), subject.before, subject.after, ended);
      // 5: OpenEXR left out a chunk that it had no memory for, and does not say why.
      if (wrong.empty()) wrong = broken_report(ended, {0, 4, 5});
      seen.wrong += !wrong.empty();
      EXPECT_EQ(wrong, "") << name << ", " << (run_with.address_space >> 20) << " MiB";
    }
    tally("address space (RLIMIT_AS) of " + std::to_string(least) + " to 800 MiB, " + std::string(name),
          seen.tries, "exit 0, 4 or 5", text_of(seen));
  }
}

TEST(Descriptors, run_out_at_every_open) {
  Seen seen;
  const Fault fault = {"no descriptors (EMFILE) from the k-th open on",
                       "open",
                       std::to_string(EMFILE),
                       true,
                       {0, 3, 5, 6, 70}};
  // Not TIFF and PNG: a library that OpenImageIO brings aborts if descriptors end while it is being loaded.
  // Before that is begun there must be enough; the limit below holds for those.
  for (const WritingVerb& v : writing_verbs())
    if ((!v.slow || long_form()) && v.name != "apply png" && v.name.rfind("apply tiff", 0) != 0)
      sweep(subject_of(v), fault, long_form() ? 500 : 20, seen);
  tally(fault.name, seen.tries, "one line, old or new", text_of(seen));
}

TEST(Descriptors, run_out_by_a_limit) {
  Seen seen;
  for (const char* name : {"apply exr", "apply tiff"}) {
    const Subject subject = subject_of(verb(name));
    for (int files = 3; files < 30; ++files) {
      Attempt run_with;
      run_with.arguments = arguments_of(*subject.verb, subject.folder);
      run_with.open_files = files;
      subject.reset();
      const Ended ended = run(run_with);
      if (ended.exit_code == 127) continue;
      ++seen.tries, ++seen.codes[ended.exit_code];
      std::string wrong = broken_promise(files_in(subject.folder), subject.before, subject.after, ended);
      if (wrong.empty()) wrong = broken_report(ended, {0, 3, 4, 5, 6});
      seen.wrong += !wrong.empty();
      EXPECT_EQ(wrong, "") << name << ", " << files << " descriptors";
    }
  }
  tally("RLIMIT_NOFILE of 3 to 29", seen.tries, "exit 0, 3, 4, 5 or 6, one line", text_of(seen));
}

TEST(Streams, closed_or_full_ones_are_errors_and_never_in_a_file) {
  const Subject subject = subject_of(verb("bake clf"));
  Seen seen;
  const auto try_it = [&](Attempt run_with, std::vector<int> codes) {
    subject.reset();
    run_with.arguments = arguments_of(*subject.verb, subject.folder);
    run_with.arguments.push_back("--json");
    const Ended ended = run(run_with);
    ++seen.tries, ++seen.codes[ended.exit_code];
    // The LUT is in place by then: the line says so.
    std::string wrong = broken_promise(files_in(subject.folder), subject.before, subject.after, ended);
    if (wrong.empty()) wrong = broken_report(ended, codes);
    if (wrong.empty() && ended.err.find("\"filesWritten\":1") == std::string::npos) wrong = ended.err;
    seen.wrong += !wrong.empty();
    EXPECT_EQ(wrong, "");
  };
  Attempt full, closed;
  full.standard_output = "/dev/full";
  closed.closed_stdout = true;
  try_it(full, {5});
  try_it(closed, {5});
  for (const char* argument : {"--help", "--version"}) {
    Attempt help = full;
    help.arguments = {argument};
    const Ended ended = run(help);
    ++seen.tries, ++seen.codes[ended.exit_code];
    EXPECT_EQ(broken_report(ended, {5}), "") << argument;
  }
  tally("standard output full or closed", seen.tries, "exit 5; what is written already is counted",
        text_of(seen));
}

TEST(Signals, a_file_that_may_not_grow_ends_the_program_as_the_signal_says) {
  Seen seen;
  for (const char* name : {"apply exr", "apply tiff pages", "lmsr", "bake clf"}) {
    const Subject subject = subject_of(verb(name));
    for (const long size : {1l, 100l, 300l}) {
      Attempt run_with;
      run_with.arguments = arguments_of(*subject.verb, subject.folder);
      run_with.file_size = size;
      subject.reset();
      const Ended ended = run(run_with);
      ++seen.tries, ++seen.codes[ended.exit_code];
      std::string wrong = broken_promise(files_in(subject.folder), subject.before, subject.after, ended);
      if (wrong.empty() && ended.exit_code != 128 + SIGXFSZ)
        wrong = "exit code " + std::to_string(ended.exit_code);
      seen.wrong += !wrong.empty();
      EXPECT_EQ(wrong, "") << name << ", " << size << " bytes";
    }
  }
  tally("SIGXFSZ (RLIMIT_FSIZE)", seen.tries, "exit 153, the old files", text_of(seen));
}

/// How long a run takes, in seconds.
double seconds_of(const Subject& subject) {
  Attempt clean;
  clean.arguments = arguments_of(*subject.verb, subject.folder);
  subject.reset();
  return run(clean).seconds;
}

/// Signals at instants that are spread evenly over a run, a little at random.
void at_random(const Subject& subject, int signal, long tries, Seen& seen) {
  std::minstd_rand random(static_cast<unsigned>(signal));
  const double whole = seconds_of(subject);
  for (long i = 0; i < tries; ++i) {
    Attempt run_with;
    run_with.arguments = arguments_of(*subject.verb, subject.folder);
    const double share =
        (static_cast<double>(i) + static_cast<double>(random() % 1000) / 1000) / static_cast<double>(tries);
    run_with.kill_after = 1.05 * whole * share;
    run_with.kill_signal = signal;
    subject.reset();
    const Ended ended = run(run_with);
    ++seen.tries, ++seen.codes[ended.exit_code];
    Files now = files_in(subject.folder);
    std::string wrong;
    if (signal == SIGKILL) {
      seen.temporaries += static_cast<long>(std::erase_if(
          now, [](const auto& file) { return file.first.find(".scotopic-") != std::string::npos; }));
      if (seen.temporaries > 0) run_with.kill_after = -1;
    }
    // Before main() has set its handlers a signal still ends it the plain way.
    const bool ended_right = ended.exit_code == 0 || ended.exit_code == 128 + signal;
    if (!ended_right) wrong = "exit code " + std::to_string(ended.exit_code) + ": " + ended.err;
    if (wrong.empty()) {
      Ended as_kill = ended;
      wrong = broken_promise(now, subject.before, subject.after, as_kill);
      if (signal == SIGKILL && wrong.rfind("empty folder", 0) == 0) wrong.clear();
    }
    seen.wrong += !wrong.empty();
    EXPECT_EQ(wrong, "") << subject.verb->name << ", after " << run_with.kill_after << " s of " << whole;
  }
}

TEST(Signals, kill_at_any_instant_leaves_the_old_file_or_the_new) {
  Seen seen;
  for (const WritingVerb& v : writing_verbs())
    at_random(subject_of(v), SIGKILL, long_form() ? 200 : v.slow ? 1 : 12, seen);
  tally("kill -9 at a random instant", seen.tries, "each file old or new", text_of(seen));
}

TEST(Signals, at_any_instant_they_end_the_program_and_leave_nothing) {
  for (const auto& [name, signal] : {std::pair{"SIGINT", SIGINT}, {"SIGTERM", SIGTERM}, {"SIGHUP", SIGHUP}}) {
    Seen seen;
    for (const WritingVerb& v : writing_verbs())
      if (!v.slow || long_form()) at_random(subject_of(v), signal, long_form() ? 50 : 6, seen);
    tally(std::string(name) + " at a random instant", seen.tries,
          "exit 128+n, each file old or new, nothing else", text_of(seen));
  }
}

TEST(Others, programs_that_write_one_file_at_once_leave_the_whole_file_of_one) {
  const std::string folder = work_folder("together");
  const auto arguments = [&](int i) {
    return std::vector<std::string>{"apply",        input("in.exr"), "-o",         folder + "/out.exr", "-q",
                                    "--adaptation", "0.1",           "--exposure", std::to_string(i)};
  };
  std::vector<std::string> alone;
  for (int i = 0; i < 4; ++i) {
    Attempt one;
    one.arguments = arguments(i);
    ASSERT_EQ(run(one).exit_code, 0);
    alone.push_back(files_in(folder).at("out.exr"));
  }
  long wrong = 0, tries = 0;
  for (int round = 0; round < (long_form() ? 50 : 8); ++round) {
    std::vector<int> children;
    const Attempt none;
    for (int i = 0; i < 4; ++i) {
      Attempt one;
      one.arguments = arguments(i);
      children.push_back(start(one, folder + "-" + std::to_string(i)));
    }
    for (int i = 0; i < 4; ++i) {
      const Ended ended =
          wait_for(children[static_cast<std::size_t>(i)], none, folder + "-" + std::to_string(i));
      ++tries;
      wrong += ended.exit_code != 0;
      EXPECT_EQ(ended.exit_code, 0) << ended.err;
    }
    const Files now = files_in(folder);
    const bool whole = now.size() == 1 && std::count(alone.begin(), alone.end(), now.at("out.exr")) == 1;
    wrong += !whole;
    EXPECT_TRUE(whole);
  }
  tally("four programs write one file at once", tries, "exit 0, the whole file of one of them",
        wrong == 0 ? "exit 0 (" + std::to_string(tries) + ")" : "WRONG " + std::to_string(wrong));
}

}  // namespace
}  // namespace scotopic::test

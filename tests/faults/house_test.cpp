// What the program does not do: start programs, talk to networks, write elsewhere, heed unlisted variables.
// And that it looks before it reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "faults/inputs.h"
#include "faults/sweep.h"
#include "support/file_bytes.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

/// Lines that the shim logged, of one kind.
std::set<std::string> logged(const std::string& log, const std::string& kind) {
  std::set<std::string> out;
  std::istringstream lines(bytes_of(log));
  for (std::string line; std::getline(lines, line);)
    if (line.rfind(kind + " ", 0) == 0) out.insert(line.substr(kind.size() + 1));
  return out;
}

TEST(House, no_verb_starts_a_program_or_opens_a_connection) {
  Seen seen;
  for (const WritingVerb& v : writing_verbs()) {
    const std::string folder = work_folder("jail");
    prepare(v, folder);
    Attempt jailed;
    jailed.arguments = arguments_of(v, folder);
    jailed.log = work_folder("") + "/jail.log";
    jailed.jail = true;
    fs::remove(jailed.log);
    const Ended ended = run(jailed);
    ASSERT_EQ(ended.err.find("no seccomp here"), std::string::npos)
        << "this system cannot hold a program in a jail";
    ++seen.tries, ++seen.codes[ended.exit_code];
    EXPECT_EQ(ended.exit_code, 0) << v.name << ": " << ended.err;
    EXPECT_EQ(logged(jailed.log, "forbidden system").size() + logged(jailed.log, "forbidden popen").size(),
              0u);
    // Nothing is opened to be written but in the folder of the output.
    for (const std::string& file : logged(jailed.log, "open"))
      EXPECT_TRUE(file.rfind(folder, 0) == 0 || file == "/dev/null" || file.rfind("/proc/self/fd/", 0) == 0)
          << v.name << ": " << file;
  }
  tally("every writing verb where the kernel kills whoever forks, executes, opens a socket", seen.tries,
        "exit 0", text_of(seen));
}

TEST(House, the_jail_kills) {
  // The same jail on a program that does start another.
  Attempt jailed;
  jailed.arguments = {"--version"};
  jailed.jail = true;
  EXPECT_EQ(run(jailed).exit_code, 0);
  const std::string command =
      "LD_PRELOAD=" SCOTOPIC_FAULT_SHIM " FAULT_JAIL=1 sh -c 'true | true' 2>/dev/null";
  EXPECT_NE(std::system(command.c_str()), 0);
}

/// What the verb asks of the environment, itself and by its libraries.
std::set<std::string> variables_asked_for(const WritingVerb& v) {
  const std::string folder = work_folder("variables");
  prepare(v, folder);
  Attempt logging;
  logging.arguments = arguments_of(v, folder);
  logging.log = work_folder("") + "/variables.log";
  fs::remove(logging.log);
  EXPECT_EQ(run(logging).exit_code, 0) << v.name;
  return logged(logging.log, "getenv");
}

/// Ours, or promised in SECURITY.md to have an effect, or the dynamic loader's and the C library's.
bool may_have_an_effect(const std::string& name) {
  const bool ocio = name == "OCIO" || name.rfind("OCIO_", 0) == 0;
  const bool stripped = name == "OCIO_LOGGING_LEVEL" || name == "OCIO_OPTIMIZATION_FLAGS";
  return (ocio && !stripped) || name.rfind("SCOTOPIC_", 0) == 0 || name.rfind("LD_", 0) == 0 ||
         name == "PATH";
}

TEST(House, whatever_variable_a_library_asks_for_has_no_effect) {
  // Which they are is the libraries' business, and changes with their releases: each is set to what switches
  // most on.
  long set = 0;
  for (const WritingVerb& v : writing_verbs()) {
    if (v.slow && v.name != "bake clf") continue;
    Attempt odd;
    for (const std::string& name : variables_asked_for(v))
      if (!may_have_an_effect(name)) odd.environment.push_back(name + "=1");
    const Subject subject = subject_of(v);
    subject.reset();
    odd.arguments = arguments_of(v, subject.folder);
    const Ended ended = run(odd);
    EXPECT_EQ(ended.exit_code, 0) << v.name << ": " << ended.err;
    EXPECT_TRUE(files_in(subject.folder) == subject.after) << v.name;
    set += static_cast<long>(odd.environment.size());
  }
  EXPECT_GT(set, 0) << "the shim does not see what is asked";
  std::printf("%ld variables that libraries asked for were set to 1\n", set);
}

TEST(House, variables_of_libraries_have_no_effect) {
  const WritingVerb& v = writing_verbs()[3];  // TIFF: OpenImageIO, too
  const Subject subject = subject_of(v);
  subject.reset();
  Attempt odd;
  odd.arguments = arguments_of(v, subject.folder);
  odd.environment = {"OCIO_LOGGING_LEVEL=debug",
                     "OCIO_OPTIMIZATION_FLAGS=0",
                     "OPENIMAGEIO_OPTIONS=log_times=1",
                     "EXPAT_MALLOC_DEBUG=2",
                     "OMP_DISPLAY_ENV=true",
                     "OPENIMAGEIO_DEBUG=9",
                     "OPENIMAGEIO_LOG_TIMES=1",
                     "OIIO_LIBRARY_PATH=" + subject.folder,
                     "LC_ALL=de_DE.UTF-8",
                     "LANG=tr_TR.UTF-8",
                     "TMPDIR=/nonexistent",
                     "HOME=/nonexistent"};
  const Ended ended = run(odd);
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err + ended.out, "");
  EXPECT_EQ(files_in(subject.folder), subject.after);
}

TEST(House, a_wrong_name_is_known_at_once) {
  const std::string in = input("in.exr"), out = work_folder("order") + "/out.exr";
  const std::vector<std::vector<std::string>> rows = {
      {"apply", in, "-o", out, "--adaptation", "1", "--colorspace", "ACESg"},
      {"apply", in, "-o", out, "--adaptation", "1", "--output-colorspace", "none"},
      {"apply", in, "-o", out, "--adaptation", "1", "--model", "x"},
      {"apply", in, "-o", out + "/none/out.exr", "--adaptation", "1"},
      {"apply", in + "none", "-o", out, "--adaptation", "1"},
      {"lmsr", in, "-o", out, "--colorspace", "ACESg"},
      {"bake", "--adaptation", "0.1", "-o", work_folder("order") + "/none/out.clf"},
      {"bake", "--adaptation", "0.1", "--config", in + "/none"},
      {"bake", "--adaptation", "0.1", "--colorspace", "ACESg", "-o", out + ".clf"},
  };
  double worst = 0;
  for (const std::vector<std::string>& row : rows) {
    // The machine may be busy: the least of a few tries is what the program needs.
    double least = 1e9;
    for (int i = 0; i < 5; ++i) {
      Attempt wrong;
      wrong.arguments = row;
      const Ended ended = run(wrong);
      EXPECT_EQ(broken_report(ended, {2, 3, 5, 6}), "") << row[0] << " " << row.back();
      least = std::min(least, ended.cpu_seconds);
    }
    EXPECT_LT(least, 0.05) << row[0] << " " << row.back();
    worst = std::max(worst, least);
  }
  std::printf("a wrong name costs %.0f ms of processor time at worst\n", 1e3 * worst);
}

TEST(House, it_looks_before_it_reads) {
  // Two faults at once: the one that is cheaper to find is the one that is said.
  const std::string folder = work_folder("order");
  fs::copy_file(input("in.exr"), folder + "/cut.exr", fs::copy_options::overwrite_existing);
  fs::resize_file(folder + "/cut.exr", fs::file_size(folder + "/cut.exr") - 20);
  const std::string cut = folder + "/cut.exr", none = folder + "/none/out.exr", out = folder + "/out.exr";
  struct Order {
    std::vector<std::string> arguments;
    int code;
  };
  for (const Order& row :
       {Order{{"--model", "x", "--config", "none.ocio", "-o", none}, 2},
        Order{{"--config", "none.ocio", "-o", none}, 6}, Order{{"--colorspace", "none", "-o", none}, 6},
        Order{{"-o", none}, 5}, Order{{"--max-pixels", "10", "-o", out}, 4}, Order{{"-o", out}, 3}}) {
    Attempt two;
    two.arguments = {"apply", cut, "--adaptation", "1", "-q"};
    two.arguments.insert(two.arguments.end(), row.arguments.begin(), row.arguments.end());
    EXPECT_EQ(broken_report(run(two), {row.code}), "") << row.arguments[0];
  }
}

}  // namespace
}  // namespace scotopic::test

// The program itself many times in one process, for tests that start it thousands of times: loading
// OpenImageIO's 250 libraries takes longer than what they test.
//
// Standard input has a command line for each run, its words parted by tabs. Standard output gets a line for
// each that ended: its exit code, a tab, and what it said on stderr, lines parted by tabs. One that takes
// longer than 5 s of processor time, or 50 s, ends the process, as a crash does: what it was is told by the
// lines that are missing.
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.h"

namespace {

constexpr int most_seconds = 5;

void start_clocks() {
  const itimerval limit = {{0, 0}, {most_seconds, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
  alarm(10 * most_seconds);
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> out = {"scotopic"};
  std::istringstream words(line);
  for (std::string word; std::getline(words, word, '\t');) out.push_back(word);
  return out;
}

/// What was written to it since the last time.
std::string take(int file) {
  std::string text(static_cast<std::size_t>(std::max<off_t>(0, lseek(file, 0, SEEK_CUR))), '\0');
  const ssize_t got = pread(file, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, got)));
  (void)!ftruncate(file, 0);
  lseek(file, 0, SEEK_SET);
  return text;
}

int run(std::vector<std::string> words) {
  using namespace scotopic;
  if (words.size() == 2 && words[1] == "(crash)") raise(SIGSEGV);  // for the tests of this one
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return run_program(static_cast<int>(words.size()), arguments.data(), {add_apply, add_explain});
}

}  // namespace

int main() {
  const int report = dup(STDOUT_FILENO);
  const int out = memfd_create("out", 0), err = memfd_create("err", 0);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  for (std::string line; std::getline(std::cin, line);) {
    start_clocks();
    const int code = run(words_of(line));
    take(STDOUT_FILENO);
    std::string said = take(STDERR_FILENO);
    std::replace(said.begin(), said.end(), '\n', '\t');
    const std::string record = std::to_string(code) + "\t" + said + "\n";
    if (write(report, record.data(), record.size()) != static_cast<ssize_t>(record.size())) return 1;
  }
  return 0;
}

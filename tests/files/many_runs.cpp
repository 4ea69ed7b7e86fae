#include "files/many_runs.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "files/made_files.h"

namespace scotopic::test {
namespace {

constexpr rlim_t most_bytes = rlim_t{1} << 30;

void write_list(const std::string& file, const std::vector<std::vector<std::string>>& lines,
                std::size_t from) {
  std::ofstream out(file);
  for (std::size_t i = from; i < lines.size(); ++i)
    for (std::size_t w = 0; w < lines[i].size(); ++w)
      out << lines[i][w] << (w + 1 < lines[i].size() ? '\t' : '\n');
}

/// The status that it ends with.
int run_list(const std::string& list, const std::string& report) {
  const pid_t child = fork();
  if (child == 0) {
    unsetenv("OCIO");
    dup2(open(list.c_str(), O_RDONLY), STDIN_FILENO);
    dup2(open(report.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO);
    const rlimit limit = {most_bytes, most_bytes};
    setrlimit(RLIMIT_AS, &limit);
    execl(SCOTOPIC_MANY, SCOTOPIC_MANY, nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::vector<OneOfMany> read_report(const std::string& file) {
  std::vector<OneOfMany> out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    OneOfMany one;
    const std::size_t tab = line.find('\t');
    one.exit_code = std::atoi(line.c_str());
    one.err = line.substr(tab + 1);
    one.one_line = std::count(one.err.begin(), one.err.end(), '\t') == 1;
    out.push_back(one);
  }
  return out;
}

}  // namespace

std::vector<OneOfMany> run_many(const std::vector<std::vector<std::string>>& command_lines) {
  const std::string list = place("list"), report = place("report");
  std::vector<OneOfMany> out;
  while (out.size() < command_lines.size()) {
    write_list(list, command_lines, out.size());
    const int status = run_list(list, report);
    const std::vector<OneOfMany> ended = read_report(report);
    out.insert(out.end(), ended.begin(), ended.end());
    if (out.size() < command_lines.size())
      out.push_back({WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status), "", false});
  }
  return out;
}

}  // namespace scotopic::test

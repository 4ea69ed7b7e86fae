#include "cli/run_program.h"

#include <OpenEXR/ImfRgbaFile.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace scotopic::test {
namespace {

std::string take(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  std::filesystem::remove(file);
  return text.str();
}

/// In the child.
void take_limits(const RunLimits& limits) {
  const auto set = [](auto what, unsigned long value) {
    const struct rlimit both = {value, value};
    setrlimit(what, &both);
  };
  if (limits.cpu_seconds > 0) set(RLIMIT_CPU, limits.cpu_seconds);
  if (limits.cpu_seconds > 0) alarm(10 * limits.cpu_seconds);
  if (limits.address_space > 0) set(RLIMIT_AS, limits.address_space);
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const RunLimits& limits) {
  const std::string base = ::testing::TempDir() + "/scotopic-cli-" + std::to_string(getpid());
  std::vector<std::string> words = {SCOTOPIC_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    unsetenv("OCIO");
    const int out = open((base + ".out").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    const int err = open((base + ".err").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    take_limits(limits);
    execv(SCOTOPIC_PROGRAM, argv.data());
    _exit(127);
  }
  int status = 0;
  struct rusage usage = {};
  wait4(child, &status, 0, &usage);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = take(base + ".out");
  outcome.err = take(base + ".err");
  outcome.peak_kib = usage.ru_maxrss;
  return outcome;
}

std::string work_folder() {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("scotopic-cli-work-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

void write_picture(const std::string& file, int width, int height) {
  Imf::RgbaOutputFile out(file.c_str(), width, height, Imf::WRITE_RGB);
  std::vector<Imf::Rgba> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float value = 0.01f + 0.99f * static_cast<float>((x * 7 + y * 13) % 101) / 100.0f;
      row[static_cast<std::size_t>(x)] = Imf::Rgba(value, value * 0.8f, value * 0.5f);
    }
    out.setFrameBuffer(row.data() - static_cast<std::ptrdiff_t>(y) * width, 1,
                       static_cast<std::size_t>(width));
    out.writePixels(1);
  }
}

}  // namespace scotopic::test

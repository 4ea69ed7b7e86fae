#include "faults/rig.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "faults/inputs.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::string take(const std::string& file) {
  std::string text = contents(file);
  fs::remove(file);
  return text;
}

void limit(int resource, long value) {
  const rlimit both = {static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

std::vector<std::string> environment_of(const Attempt& what, const std::string& base) {
  std::vector<std::string> out = {"PATH=/usr/bin:/bin"};
  const bool shim = !what.call.empty() || !what.log.empty() || what.jail;
  if (shim) out.push_back("LD_PRELOAD=" SCOTOPIC_FAULT_SHIM);
  if (!what.call.empty()) {
    out.push_back("FAULT_CALL=" + what.call);
    out.push_back("FAULT_DO=" + what.action);
    out.push_back("FAULT_AT=" + std::to_string(what.at));
    out.push_back("FAULT_COUNTS=" + base + ".counts");
  }
  if (what.sticky) out.emplace_back("FAULT_STICKY=1");
  if (!what.folder.empty()) out.push_back("FAULT_FOLDER=" + what.folder);
  if (!what.log.empty()) out.push_back("FAULT_LOG=" + what.log);
  if (what.jail) out.emplace_back("FAULT_JAIL=1");
  out.insert(out.end(), what.environment.begin(), what.environment.end());
  return out;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

}  // namespace

int start(const Attempt& what, const std::string& base) {
  std::vector<std::string> words = {what.program}, variables = environment_of(what, base);
  words.insert(words.end(), what.arguments.begin(), what.arguments.end());
  const std::vector<char*> argv = pointers(words), envp = pointers(variables);
  const pid_t child = fork();
  if (child != 0) return child;
  const std::string to = what.standard_output.empty() ? base + ".out" : what.standard_output;
  dup2(open(to.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO);
  dup2(open((base + ".err").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
  if (what.closed_stdout) close(STDOUT_FILENO);
  closefrom(3);
  limit(RLIMIT_CORE, 0);
  if (what.address_space > 0) limit(RLIMIT_AS, what.address_space);
  if (what.file_size > 0) limit(RLIMIT_FSIZE, what.file_size);
  if (what.no_size_signal) signal(SIGXFSZ, SIG_IGN);
  if (what.open_files > 0) limit(RLIMIT_NOFILE, what.open_files);
  execve(what.program.c_str(), argv.data(), envp.data());
  _exit(127);
}

Ended wait_for(int child, const Attempt& what, const std::string& base) {
  const auto began = Clock::now();
  if (what.kill_after >= 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(what.kill_after));
    kill(child, what.kill_signal);
  }
  int status = 0;
  struct rusage usage = {};
  wait4(child, &status, 0, &usage);
  Ended ended;
  ended.seconds = std::chrono::duration<double>(Clock::now() - began).count();
  ended.cpu_seconds = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                      1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  ended.by_signal = WIFSIGNALED(status);
  ended.exit_code = ended.by_signal ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (what.standard_output.empty()) ended.out = take(base + ".out");
  ended.err = take(base + ".err");
  std::istringstream lines(fs::exists(base + ".counts") ? take(base + ".counts") : "");
  std::string name;
  for (long count = 0; lines >> name >> count;) ended.calls[name] = count;
  return ended;
}

Ended run(const Attempt& what) {
  const std::string base = work_folder("") + "/run-" + std::to_string(getpid());
  return wait_for(start(what, base), what, base);
}

namespace {

/// OpenImageIO writes the time into TIFF files: "2026:11:25 23:11:17".
std::string without_date(std::string text) {
  static const std::regex date("20[0-9][0-9]:[0-9][0-9]:[0-9][0-9] [0-9][0-9]:[0-9][0-9]:[0-9][0-9]");
  for (std::smatch found; std::regex_search(text, found, date);)
    text.replace(static_cast<std::size_t>(found.position()), static_cast<std::size_t>(found.length()), "now");
  return text;
}

}  // namespace

Files files_in(const std::string& folder) {
  Files out;
  if (!fs::exists(folder)) return out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    out[name] = entry.is_directory()                 ? "/"
                : entry.path().extension() == ".tif" ? without_date(contents(entry.path().string()))
                                                     : contents(entry.path().string());
  }
  return out;
}

const std::vector<WritingVerb>& writing_verbs() {
  static const std::vector<WritingVerb> verbs = {
      {"apply new exr", {"apply", "@/in.exr", "-o", "@/out.exr", "--adaptation", "0.1", "-q"}, {}},
      {"apply exr", {"apply", "@/in.exr", "-o", "@/out.exr", "--adaptation", "0.1", "-q"}, {"out.exr"}},
      {"apply in place", {"apply", "@/in.exr", "-o", "@/in.exr", "--adaptation", "0.1", "-q"}, {}},
      {"apply tiff", {"apply", "@/in.exr", "-o", "@/out.tif", "--adaptation", "0.1", "-q"}, {"out.tif"}},
      {"apply tiff pages",
       {"apply", "@/pages.tif", "-o", "@/out.tif", "--adaptation", "0.1", "-q"},
       {"out.tif"}},
      {"apply png", {"apply", "@/in.exr", "-o", "@/out.png", "--adaptation", "0.1", "-q"}, {"out.png"}},
      {"lmsr", {"lmsr", "@/in.exr", "-o", "@/out.exr", "-q"}, {"out.exr"}},
      {"bake clf",
       {"bake", "--adaptation", "0.1", "--size", "17", "-o", "@/out.clf", "-q"},
       {"out.clf"},
       true},
      {"bake cubes",
       {"bake", "--adaptation", "0.1", "--adaptation", "1", "--size", "17", "--colorspace", "ACEScct", "-o",
        "@/out.cube", "-q"},
       {"out_0.1.cube", "out_1.cube"},
       true},
      {"bake config",
       {"bake", "--adaptation", "0.1", "--size", "17", "--config", "@/show", "--force", "-q"},
       {"show/config.ocio", "show/luts/MANIFEST"},
       true},
      {"bake new config",
       {"bake", "--adaptation", "0.1", "--size", "17", "--config", "@/a/show", "-q"},
       {},
       true},
      {"bake into",
       {"bake", "--adaptation", "0.1", "--size", "17", "--into", "@/studio.ocio", "-q"},
       {},
       true},
  };
  return verbs;
}

const WritingVerb& verb(const std::string& name) {
  for (const WritingVerb& v : writing_verbs())
    if (v.name == name) return v;
  throw std::logic_error("no such verb");
}

void prepare(const WritingVerb& verb, const std::string& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto needs = [&](const char* name) {
    return std::any_of(verb.arguments.begin(), verb.arguments.end(),
                       [&](const std::string& a) { return a == std::string("@/") + name; });
  };
  if (needs("in.exr")) fs::copy_file(input("in.exr"), folder + "/in.exr");
  if (needs("pages.tif")) fs::copy_file(input("pages.tif"), folder + "/pages.tif");
  if (needs("studio.ocio")) fs::copy_file(input("studio.ocio"), folder + "/studio.ocio");
  for (const std::string& name : verb.old_files) {
    fs::create_directories(fs::path(folder + "/" + name).parent_path());
    std::ofstream(folder + "/" + name) << "old";
  }
}

std::vector<std::string> arguments_of(const WritingVerb& verb, const std::string& folder) {
  std::vector<std::string> out = verb.arguments;
  for (std::string& a : out)
    if (a.rfind("@/", 0) == 0) a = folder + a.substr(1);
  return out;
}

std::string broken_promise(const Files& now, const Files& before, const Files& after, const Ended& ended) {
  const auto as_in = [](const Files& files, const std::string& name, const std::string& text) {
    const auto found = files.find(name);
    return found != files.end() && found->second == text;
  };
  for (const auto& [name, text] : now) {
    if (!before.count(name) && !after.count(name)) return "litter: " + name;
    if (!as_in(before, name, text) && !as_in(after, name, text)) return "neither old nor new: " + name;
  }
  for (const auto& [name, text] : before)
    if (!now.count(name)) return "lost: " + name;
  if (!ended.by_signal && ended.exit_code == 0 && now != after) return "said done, and is not";
  // Folders that were made for nothing are litter, too.
  for (const auto& [name, text] : now)
    if (text == "/" && !before.count(name)) {
      const auto next = now.upper_bound(name);
      if (next == now.end() || next->first.rfind(name + "/", 0) != 0) return "empty folder: " + name;
    }
  return "";
}

std::string broken_report(const Ended& ended, const std::vector<int>& codes) {
  const std::string said = std::to_string(ended.exit_code) + ": " + ended.err;
  if (ended.by_signal) return "crashed, " + said;
  if (std::find(codes.begin(), codes.end(), ended.exit_code) == codes.end()) return "exit code " + said;
  if (ended.exit_code == 0 || ended.exit_code > 128) return "";
  // What a library says before it gives up stands before our line.
  const std::string given_up = "scotopic: internal error: a library ended the program (nothing written)\n";
  if (ended.err.ends_with(given_up)) return "";
  if (std::count(ended.err.begin(), ended.err.end(), '\n') != 1) return "not one line, " + said;
  if (ended.err.rfind("scotopic: ", 0) != 0 && ended.err.rfind("{\"error\"", 0) != 0)
    return "not our line, " + said;
  return "";
}

namespace {

/// Takes the work folder away at the end.
class Tidy : public ::testing::Environment {
 public:
  void TearDown() override { fs::remove_all(work_folder("")); }
};
const ::testing::Environment* const tidy = ::testing::AddGlobalTestEnvironment(new Tidy);

}  // namespace

std::string work_folder(const std::string& name) {
  const fs::path folder = fs::path(SCOTOPIC_FAULT_FOLDER) / std::to_string(getpid()) / name;
  fs::create_directories(folder);
  return name.empty() ? folder.parent_path().string() : folder.string();
}

bool long_form() {
  const char* form = std::getenv("SCOTOPIC_FAULTS");
  return form && std::string(form) == "long";
}

void tally(const std::string& fault, long tries, const std::string& expected, const std::string& seen) {
  std::printf("| %s | %ld | %s | %s |\n", fault.c_str(), tries, expected.c_str(), seen.c_str());
  if (const char* table = std::getenv("SCOTOPIC_FAULT_TABLE"))
    std::ofstream(table, std::ios::app)
        << "| " << fault << " | " << tries << " | " << expected << " | " << seen << " |\n";
}

}  // namespace scotopic::test

#include "color/lut_trial.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <tuple>

#include "base/error.h"

namespace OCIO = OCIO_NAMESPACE;

namespace scotopic {
namespace {

constexpr int no_memory = 1;

[[maybe_unused]] rlim_t bytes_mapped() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void set_limit(int resource, rlim_t value) {
  struct rlimit limit = {};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  limit.rlim_cur = limit.rlim_max == RLIM_INFINITY ? value : std::min(value, limit.rlim_max);
  if (resource == RLIMIT_CORE) limit.rlim_max = limit.rlim_cur;
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

[[noreturn]] void read_in_child(const std::string& file, rlim_t size) {
  const int nothing = open("/dev/null", O_WRONLY);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
  for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) signal(fatal, SIG_DFL);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, 1 + size / (rlim_t{4} << 20));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  set_limit(RLIMIT_AS, bytes_mapped() + (rlim_t{1} << 30) + 64 * size);
#endif
  try {
    const OCIO::FileTransformRcPtr transform = OCIO::FileTransform::Create();
    transform->setSrc(file.c_str());
    transform->setInterpolation(OCIO::INTERP_BEST);
    (void)OCIO::Config::CreateRaw()->getProcessor(transform);
  } catch (const std::bad_alloc&) {
    _exit(no_memory);
  } catch (const std::length_error&) {
    _exit(no_memory);
  } catch (...) {
    // The caller meets it, and says which LUT of which config.
  }
  _exit(0);
}

/// The status that a child ends with.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

void try_now(const std::string& file, rlim_t size) {
  const pid_t child = fork();
  if (child < 0)
    throw Error(ExitCode::limit, file, "cannot be tried in a process of its own: no process is to be had");
  if (child == 0) read_in_child(file, size);
  const int status = wait_for(child);
  if (WIFEXITED(status) && WEXITSTATUS(status) == no_memory)
    throw Error(ExitCode::limit, file, "is damaged: OpenColorIO wants more than 1 GiB of memory to read it");
  if (!WIFSIGNALED(status)) return;
  const bool time = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL;
  throw Error(ExitCode::config, file,
              time ? "is damaged: OpenColorIO comes to no end reading it"
                   : "is damaged: OpenColorIO crashes reading it");
}

}  // namespace

void try_lut_file(const std::string& file) {
  using Identity = std::tuple<dev_t, ino_t, off_t, time_t, long>;
  static std::mutex lock;
  static std::set<Identity> tried;
  struct stat info = {};
  if (stat(file.c_str(), &info) != 0) return;
  const Identity identity{info.st_dev, info.st_ino, info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec};
  const std::lock_guard guard(lock);
  if (tried.count(identity)) return;
  try_now(file, static_cast<rlim_t>(info.st_size));
  tried.insert(identity);
}

}  // namespace scotopic

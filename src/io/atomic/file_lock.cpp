#include "io/atomic/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/error.h"

namespace scotopic {
namespace {

constexpr std::chrono::milliseconds pause(20);
constexpr std::chrono::seconds patience(60);

/// Locks of NFS want a descriptor for writing; folders have none.
int open_any(const std::string& path) {
  const int writing = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  return writing >= 0 ? writing : open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

/// Whether the name still leads to what is open.
bool in_place(int descriptor, const std::string& path) {
  struct stat open_file = {}, named = {};
  return fstat(descriptor, &open_file) == 0 && stat(path.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

}  // namespace

FileLock::FileLock(const std::string& path, const std::function<void()>& waiting) {
  const auto end = std::chrono::steady_clock::now() + patience;
  for (bool told = false;;) {
    if (descriptor_ < 0) descriptor_ = open_any(path);
    if (descriptor_ < 0)
      throw Error(ExitCode::output, path, std::string("cannot be opened: ") + std::strerror(errno));
    const bool locked = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno != EWOULDBLOCK && errno != EINTR) return;
    if (locked && in_place(descriptor_, path)) return;
    if (locked) {
      close(descriptor_);
      descriptor_ = -1;
      continue;
    }
    if (!told) waiting();
    told = true;
    if (std::chrono::steady_clock::now() > end) {
      close(descriptor_);
      throw Error(ExitCode::output, path, "another program is at work on it: nothing is written");
    }
    std::this_thread::sleep_for(pause);
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace scotopic

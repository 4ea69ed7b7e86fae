#include "base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/limits.h"

namespace scotopic {
namespace {

[[noreturn]] void fail(const std::string& file, ExitCode code, int error) {
  throw Error(code, file, std::string("cannot be read: ") + std::strerror(error));
}

class Descriptor {
 public:
  // Without O_NONBLOCK a pipe that nobody writes to would hold us here.
  Descriptor(const std::string& file, ExitCode code)
      : number(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (number < 0) fail(file, code, errno);
  }
  ~Descriptor() { close(number); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  const int number;
};

std::int64_t checked_size(int descriptor, const std::string& file, ExitCode code, std::int64_t limit,
                          const char* option) {
  struct stat info = {};
  if (fstat(descriptor, &info) != 0) fail(file, code, errno);
  if (S_ISDIR(info.st_mode)) throw Error(code, file, "is a folder, not a file");
  if (!S_ISREG(info.st_mode)) throw Error(code, file, "is not a regular file");
  check_limit(file, "size in bytes", info.st_size, limit, option);
  return info.st_size;
}

}  // namespace

std::int64_t check_input_file(const std::string& file, ExitCode code, std::int64_t limit,
                              const char* option) {
  const Descriptor descriptor(file, code);
  return checked_size(descriptor.number, file, code, limit, option);
}

std::string read_input_file(const std::string& file, ExitCode code, std::int64_t limit, const char* option) {
  const Descriptor descriptor(file, code);
  std::string text(static_cast<std::size_t>(checked_size(descriptor.number, file, code, limit, option)),
                   '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = read(descriptor.number, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(file, code, errno);
    if (n == 0) break;  // cut short meanwhile: its reader will say what is missing
    done += static_cast<std::size_t>(n);
  }
  text.resize(done);
  return text;
}

FileState::FileState(const std::string& file) : file_(file) {
  struct stat info = {};
  if (stat(file.c_str(), &info) != 0) return;  // whoever opens it says so
  device_ = info.st_dev;
  inode_ = info.st_ino;
  size_ = info.st_size;
  seconds_ = info.st_mtim.tv_sec;
  nanoseconds_ = info.st_mtim.tv_nsec;
}

void FileState::require_unchanged() const {
  const FileState now(file_);
  const bool same_file = device_ == now.device_ && inode_ == now.inode_;
  if (same_file && (size_ != now.size_ || seconds_ != now.seconds_ || nanoseconds_ != now.nanoseconds_))
    throw Error(ExitCode::input, file_, "was changed while it was read");
}

}  // namespace scotopic

#include "image/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "image/error.h"

namespace scotopic {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;
constexpr std::array<int, 5> ending_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ};

/// Names a signal handler must unlink. Slots are claimed and released by the threads that write.
struct Unfinished {
  std::atomic<bool> claimed{false};
  std::atomic<bool> valid{false};
  char name[PATH_MAX] = {};
};
std::array<Unfinished, 16> unfinished;

int register_unfinished(const std::string& name) {
  if (name.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < unfinished.size(); ++i) {
    if (unfinished[i].claimed.exchange(true)) continue;
    std::memcpy(unfinished[i].name, name.c_str(), name.size() + 1);
    unfinished[i].valid = true;
    return static_cast<int>(i);
  }
  return -1;
}

void release_unfinished(int slot) {
  if (slot < 0) return;
  unfinished[static_cast<std::size_t>(slot)].valid = false;
  unfinished[static_cast<std::size_t>(slot)].claimed = false;
}

// Only what POSIX allows in a handler: lock-free loads, unlink, _exit.
extern "C" void end_on_signal(int signal_number) {
  for (Unfinished& file : unfinished)
    if (file.valid.load()) unlink(file.name);
  _exit(128 + signal_number);
}

/// While it lives, the ending signals wait: between giving a file its name and putting it in place.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t held;
    sigemptyset(&held);
    for (const int s : ending_signals) sigaddset(&held, s);
    pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_;
};

/// A name beside the target that nothing else uses: hidden, so that no sequence pattern matches it.
std::string temporary_name(const std::string& folder, int attempt) {
  return fmt::format("{}/.scotopic-{}-{}.tmp", folder, getpid(), attempt);
}

mode_t permissions_of_new_files() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

void remove_unfinished_files_on_signals() {
  struct sigaction action = {};
  action.sa_handler = end_on_signal;
  sigfillset(&action.sa_mask);
  for (const int s : ending_signals) {
    struct sigaction before = {};
    // nohup and shells' background jobs ignore some signals: let them.
    if (sigaction(s, nullptr, &before) == 0 && before.sa_handler == SIG_IGN && s != SIGPIPE) continue;
    sigaction(s, &action, nullptr);
  }
}

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
  std::error_code ignored;
  const std::filesystem::path real = std::filesystem::canonical(path, ignored);
  if (!real.empty()) target_ = real.string();
  struct stat info = {};
  const bool exists = stat(target_.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode))
    throw Error(ExitCode::output, path_, "is a folder, not a file to write");
  if (exists && !S_ISREG(info.st_mode))
    throw Error(ExitCode::output, path_, "is a device, not a file to write");
  folder_ = std::filesystem::path(target_).parent_path().string();
  if (folder_.empty()) folder_.push_back('.');
  buffer_.reserve(buffer_size);
  open_temporary();
  // What fchmod cannot set (another owner's file, FAT) is not worth failing for.
  (void)fchmod(descriptor_, exists ? info.st_mode & 07777 : permissions_of_new_files());
}

void OutputFile::open_temporary() {
  descriptor_ = open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor_ >= 0) return;
  if (errno == ENOENT || errno == ENOTDIR)
    throw Error(ExitCode::output, path_, "the folder '" + folder_ + "' does not exist");
  if (errno == EACCES || errno == EROFS) fail(errno);
  const SignalsHeld held;
  for (int attempt = 0; descriptor_ < 0 && attempt < 100; ++attempt) {
    temporary_ = temporary_name(folder_, attempt);
    descriptor_ = open(temporary_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) {
    temporary_.clear();
    fail(errno);
  }
  registered_ = register_unfinished(temporary_);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
  release_unfinished(registered_);
}

void OutputFile::fail(int error) const {
  throw Error(ExitCode::output, path_, std::string("cannot write: ") + std::strerror(error));
}

std::string OutputFile::open_name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

void OutputFile::check() const {
  if (error_ != 0) fail(error_);
}

bool OutputFile::flush() noexcept {
  const std::byte* data = buffer_.data();
  std::size_t left = buffer_.size();
  std::int64_t at = buffer_start_;
  while (left > 0 && error_ == 0) {
    const ssize_t n = pwrite(descriptor_, data, left, at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      error_ = n < 0 ? errno : EIO;
    } else {
      data += n;
      at += n;
      left -= static_cast<std::size_t>(n);
    }
  }
  buffer_.clear();
  return error_ == 0;
}

bool OutputFile::write(const void* data, std::size_t size) noexcept {
  if (error_ != 0) return false;
  const auto* bytes = static_cast<const std::byte*>(data);
  while (size > 0) {
    const bool appends = position_ == buffer_start_ + static_cast<std::int64_t>(buffer_.size());
    if ((!appends || buffer_.size() == buffer_size) && !flush()) return false;
    if (buffer_.empty()) buffer_start_ = position_;
    const std::size_t n = std::min(size, buffer_size - buffer_.size());
    buffer_.insert(buffer_.end(), bytes, bytes + n);  // within the reserve: does not allocate
    bytes += n;
    size -= n;
    position_ += static_cast<std::int64_t>(n);
    size_ = std::max(size_, position_);
  }
  return true;
}

std::size_t OutputFile::read(void* data, std::size_t size) noexcept {
  if (!flush()) return 0;
  auto* bytes = static_cast<std::byte*>(data);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = pread(descriptor_, bytes + done, size - done, position_);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
    position_ += n;
  }
  return done;
}

void OutputFile::publish() {
  const SignalsHeld held;
  if (temporary_.empty()) {
    const std::string open_file = open_name();
    // linkat does not replace: where the target exists the file gets a name of its own first.
    if (linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, target_.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
    int linked = -1;
    for (int attempt = 0; linked != 0 && attempt < 100; ++attempt) {
      temporary_ = temporary_name(folder_, attempt);
      linked = linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, temporary_.c_str(), AT_SYMLINK_FOLLOW);
      if (linked != 0 && errno != EEXIST) break;
    }
    if (linked != 0) {
      temporary_.clear();
      fail(errno);
    }
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void OutputFile::commit() {
  flush();
  check();
  if (fsync(descriptor_) != 0) fail(errno);
  publish();
  const int closed = close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail(errno);
  // The name, too, must survive a power cut; a folder that cannot be synced is no reason to fail.
  const int folder = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) {
    (void)fsync(folder);
    close(folder);
  }
}

}  // namespace scotopic

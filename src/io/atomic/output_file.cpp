#include "io/atomic/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace scotopic {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = std::size_t{1} << 20;
constexpr int attempts = 100;

std::atomic<int> published{0};

/// FNV-1a: names need not be secret, only differ.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// A name beside the target, the same for each run, of a length that every file system takes; hidden, so that
/// no sequence pattern matches it.
std::string temporary_name(const std::string& target, int attempt) {
  const fs::path path(target);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  return fmt::format("{}/.scotopic-{:016x}-{}.tmp", folder, hash_of(path.filename().string()), attempt);
}

mode_t permissions_of_new_files() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

bool same_file(int descriptor, const std::string& name) {
  struct stat open_file = {}, named = {};
  return fstat(descriptor, &open_file) == 0 && lstat(name.c_str(), &named) == 0 &&
         open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

/// A temporary whose program is gone has lost its lock. False: there is nothing of that name.
bool remove_if_abandoned(const std::string& name) {
  const int descriptor = open(name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return errno != ENOENT;
  struct stat info = {};
  if (fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode) && flock(descriptor, LOCK_EX | LOCK_NB) == 0 &&
      same_file(descriptor, name))
    unlink(name.c_str());
  close(descriptor);
  return true;
}

/// Where a path leads, links followed, also those whose target is not there.
std::string followed(const std::string& path) {
  fs::path at = path;
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(at, error); ++links) {
    const fs::path to = fs::read_symlink(at, error);
    if (error) break;
    at = to.is_absolute() ? to : at.parent_path() / to;
  }
  const fs::path folder = at.has_parent_path() ? at.parent_path() : fs::path(".");
  const fs::path real = fs::canonical(folder, error);
  return error ? at.string() : (real / at.filename()).string();
}

/// 0, or why the names in a folder may not be on the disk. A folder that may not be read, or a file system
/// that does not sync folders, is no fault.
int sync_folder(const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return 0;
  int error = 0;
  do error = fsync(descriptor) == 0 ? 0 : errno;
  while (error == EINTR);
  close(descriptor);
  return error == EINVAL || error == EROFS || error == EOPNOTSUPP || error == ENOSYS ? 0 : error;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ExitCode::output, path, what);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(followed(path)) {
  if (path == "-")
    refuse(path_, "standard output cannot be written to: name a file (./- for one of that name)");
  struct stat info = {};
  const bool exists = stat(target_.c_str(), &info) == 0;
  // A name that is too long, a folder that may not be entered: better known now than after the work.
  if (!exists && errno != ENOENT && errno != ENOTDIR) fail(errno);
  if ((exists && S_ISDIR(info.st_mode)) || fs::path(target_).filename().empty())
    refuse(path_, "is a folder, not a file to write");
  if (exists && !S_ISREG(info.st_mode)) refuse(path_, "is a device, not a file to write");
  if (exists && faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0)
    refuse(path_, std::string("is write-protected: ") + std::strerror(errno));
  folder_ = fs::path(target_).parent_path().string();
  if (folder_.empty()) folder_.push_back('.');
  buffer_.reserve(buffer_size);
  open_temporary();
  // What cannot be set (another owner's file, FAT) is not worth failing for.
  if (exists && (info.st_uid != geteuid() || info.st_gid != getegid()))
    (void)!fchown(descriptor_, info.st_uid, info.st_gid);
  (void)fchmod(descriptor_, exists ? info.st_mode & 0777 : permissions_of_new_files());
}

void OutputFile::open_temporary() {
  for (int attempt = 0; attempt < attempts; ++attempt)
    if (!remove_if_abandoned(temporary_name(target_, attempt))) break;
  descriptor_ = open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor_ < 0 && (errno == ENOENT || errno == ENOTDIR))
    refuse(path_, "the folder '" + folder_ + "' does not exist");
  if (descriptor_ < 0 && (errno == EACCES || errno == EROFS)) fail(errno);
  if (descriptor_ >= 0) {
    lock();
    // Without /proc a nameless file cannot be given a name.
    if (access(open_name().c_str(), F_OK) == 0) return;
    close(descriptor_);
    descriptor_ = -1;
  }
  const SignalsHeld held;
  int error = 0;
  for (int attempt = 0; attempt < attempts && descriptor_ < 0; ++attempt) {
    error = make_temporary(attempt);
    if (error != 0 && error != EEXIST) break;
  }
  if (descriptor_ < 0) fail(error);
  registered_.emplace(temporary_);
}

/// 0, or why there is no temporary file of that number.
int OutputFile::make_temporary(int attempt) {
  const std::string name = temporary_name(target_, attempt);
  descriptor_ = open(name.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0600);
  if (descriptor_ < 0) return errno;
  lock();
  // Before the lock it looked abandoned.
  if (!same_file(descriptor_, name)) {
    close(descriptor_);
    descriptor_ = -1;
    return EEXIST;
  }
  temporary_ = name;
  return 0;
}

void OutputFile::lock() const noexcept { (void)flock(descriptor_, LOCK_EX | LOCK_NB); }

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
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

void OutputFile::complete() {
  flush();
  check();
  int synced = 0;
  do synced = fsync(descriptor_);
  while (synced != 0 && errno == EINTR);
  if (synced != 0) fail(errno);
  // What only close() reports, on network file systems, must be known while the target is still the old one.
  const int again = fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
  if (again < 0 || close(again) != 0) fail(errno);
  std::vector<std::byte>().swap(buffer_);
}

/// 0, or why the target is still what it was.
int OutputFile::put_in_place() {
  if (temporary_.empty()) {
    const std::string open_file = open_name();
    const auto link = [&](const std::string& name) {
      return linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
    };
    // linkat does not replace: where the target exists the file gets a name of its own first.
    int error = link(target_);
    if (error != EEXIST) return error;
    for (int attempt = 0; attempt < attempts && error == EEXIST; ++attempt) {
      temporary_ = temporary_name(target_, attempt);
      error = link(temporary_);
    }
    if (error != 0) {
      temporary_.clear();
      return error;
    }
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int error = errno;
    unlink(temporary_.c_str());
    temporary_.clear();
    return error;
  }
  temporary_.clear();
  return 0;
}

void OutputFile::publish() {
  int error = 0;
  {
    const SignalsHeld held;
    error = put_in_place();
    registered_.reset();
    if (error == 0) ++published;
  }
  if (error != 0) fail(error);
  // All is safe already: there is nothing left that close() could lose.
  close(descriptor_);
  descriptor_ = -1;
  // The name, too, should survive a power cut.
  if (const int unsynced = sync_folder(folder_))
    refuse(path_,
           std::string("is in place, but might not survive a power cut: its folder cannot be synced: ") +
               std::strerror(unsynced));
}

int files_in_place() noexcept { return published; }

void require_writable_folder(const std::string& path) {
  fs::path at = fs::path(path);
  struct stat info = {};
  while (stat(at.empty() ? "." : at.c_str(), &info) != 0) {
    if (errno != ENOENT) refuse(path, std::string("cannot be written to: ") + std::strerror(errno));
    at = at.parent_path();
  }
  if (!S_ISDIR(info.st_mode)) refuse(path, "cannot be made: '" + at.string() + "' is not a folder");
  if (faccessat(AT_FDCWD, at.empty() ? "." : at.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    refuse(path, std::string("cannot be written to: ") + std::strerror(errno));
}

}  // namespace scotopic

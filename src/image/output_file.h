// A file that is there whole, or not at all: written beside its target, renamed when complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scotopic {

/// Opens a nameless file (O_TMPFILE, else a hidden temporary) in the target's folder; commit() checks, syncs
/// and puts it in the target's place in one step; without commit() nothing stays. The target may be a file
/// being read. A target that is a folder or a device is refused; a symbolic link is followed, the mode of an
/// existing file kept. Throws Error(ExitCode::output). Not for use by two threads at once.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const noexcept { return path_; }

  /// A name under which a library that takes only names can open and write the file, instead of write().
  std::string open_name() const;

  /// All of it, or false; then the reason is kept and every later call fails too.
  bool write(const void* data, std::size_t size) noexcept;
  /// Bytes read back from what was written, at the current position; fewer at the end.
  std::size_t read(void* data, std::size_t size) noexcept;
  void seek(std::int64_t position) noexcept { position_ = position; }
  std::int64_t tell() const noexcept { return position_; }
  std::int64_t size() const noexcept { return size_; }

  /// Throws if any write failed.
  void check() const;
  /// Throws, and leaves the target as it was, unless every byte is safely in place.
  void commit();

 private:
  bool flush() noexcept;
  [[noreturn]] void fail(int error) const;
  void open_temporary();
  void publish();

  std::string path_;       // as the user wrote it
  std::string target_;     // links followed
  std::string folder_;     // of target_
  std::string temporary_;  // empty while the file has no name
  int descriptor_ = -1;
  int error_ = 0;
  std::int64_t position_ = 0;
  std::int64_t size_ = 0;
  std::int64_t buffer_start_ = 0;
  std::vector<std::byte> buffer_;
  int registered_ = -1;
};

/// From now on SIGINT, SIGTERM, SIGHUP, SIGPIPE and SIGXFSZ remove unfinished files and end the program with
/// 128 + their number.
void remove_unfinished_files_on_signals();

}  // namespace scotopic

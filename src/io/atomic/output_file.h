// A file that is there whole, or not at all: written beside its target, put in its place when complete.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/atomic/unfinished_files.h"

namespace scotopic {

/// Opens a nameless file (O_TMPFILE, else a hidden temporary) in the target's folder; commit() checks, syncs
/// and puts it in the target's place in one step; without commit() nothing stays. The target may be a file
/// being read. A target that is a folder, a device or write-protected is refused; a symbolic link is
/// followed, the mode of an existing file kept. Throws Error(ExitCode::output). Not for use by two threads at
/// once.
///
/// Only a kill that no program can catch, between two system calls of publish(), leaves a hidden temporary;
/// the next OutputFile of that target removes it (it is locked while its program lives).
class OutputFile {
 public:
  /// `path`: the target.
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The target, as it was named.
  const std::string& path() const noexcept { return path_; }

  /// A name under which a library that takes only names can open and write the file, instead of write(), or
  /// read what was completed.
  std::string open_name() const;

  /// All of it, or false; then the reason is kept and every later call fails too.
  bool write(const void* data, std::size_t size) noexcept;
  /// Bytes read back from what was written, at the current position; fewer at the end.
  std::size_t read(void* data, std::size_t size) noexcept;
  /// Where the next write() or read() begins, bytes from the start; may lie beyond the end.
  void seek(std::int64_t position) noexcept { position_ = position; }
  /// That position.
  std::int64_t tell() const noexcept { return position_; }
  /// Bytes from the start to the last one written.
  std::int64_t size() const noexcept { return size_; }

  /// Throws if any write failed.
  void check() const;

  /// Throws unless every byte is on the disk. The target is as it was.
  void complete();
  /// Puts the completed file in its place, in one step; throws, and leaves the target as it was, if it
  /// cannot. Throws, too, where the file is in place but its folder cannot be synced.
  void publish();
  /// Both.
  void commit() {
    complete();
    publish();
  }

 private:
  bool flush() noexcept;
  [[noreturn]] void fail(int error) const;
  void open_temporary();
  int make_temporary(int attempt);
  int put_in_place();
  void lock() const noexcept;

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
  std::optional<UnfinishedName> registered_;
};

/// How many files publish() has put in place since the program began.
int files_in_place() noexcept;

/// Throws Error(output) for `path` where a file of that name could not be made for want of a folder that can
/// be written to. A folder that is not there yet is taken to be made: then the one above counts.
void require_writable_folder(const std::string& path);

}  // namespace scotopic

// Files read whole, or looked at before a library opens them by name.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.h"

namespace scotopic {

/// Throws Error(code) unless `file` is there, a regular file (no folder, device or pipe, which could be
/// without end) and may be read; Error(limit) unless it is of no more than `limit` bytes, which `option`
/// raises (empty: none does). Returns its size.
std::int64_t check_input_file(const std::string& file, ExitCode code, std::int64_t limit, const char* option);

/// All of the file, after that check.
std::string read_input_file(const std::string& file, ExitCode code, std::int64_t limit, const char* option);

/// What a file was when reading it began.
class FileState {
 public:
  /// As it is now.
  explicit FileState(const std::string& file);
  /// Throws Error(input) if the same file has another size or time now: what was read may be of two states. A
  /// file put in its place under the same name is no change of the one that is being read.
  void require_unchanged() const;

 private:
  std::string file_;
  std::uint64_t device_ = 0, inode_ = 0;
  std::int64_t size_ = 0, seconds_ = 0, nanoseconds_ = 0;
};

}  // namespace scotopic

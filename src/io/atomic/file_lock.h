// One program at a time at work on a file, or on what is in a folder.
#pragma once

#include <functional>
#include <string>

namespace scotopic {

/// An advisory lock (flock) that ends with this or with the program; nothing is left behind. Where the file
/// is replaced while it waits, it waits for the new one. A file system without locks is none to wait for.
class FileLock {
 public:
  /// `path` exists. Calls `waiting` once, if another program holds it; Error(output) where that lasts over a
  /// minute.
  FileLock(const std::string& path, const std::function<void()>& waiting);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace scotopic

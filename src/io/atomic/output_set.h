// Files that belong together, a config and its LUTs say: none takes its place before all are on the disk.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/atomic/output_file.h"

namespace scotopic {

/// Errors are Error(ExitCode::output). Until commit() nothing is seen of the files, and if it is not reached,
/// or fails before the first is in place, nothing stays. commit() gives the files their places one after the
/// other, in the order they were opened: each is old or new, and only what ends the program within these few
/// system calls leaves some old and some new.
class OutputSet {
 public:
  OutputSet() = default;
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// Makes a folder and those above it; what was made goes again if no file comes to lie there.
  void make_folder(const std::string& path);
  /// Opens a file of the set, to be written with write(); what forbids it is known here.
  OutputFile& open(const std::string& path);
  /// Writes and syncs a file of this text, reads it back and compares. Its open_name() can be read then.
  static void write(OutputFile& file, const std::string& text);
  /// open() and write() of this text.
  OutputFile& add(const std::string& path, const std::string& text);
  /// Puts every file in its place; see above.
  void commit();

 private:
  struct MadeFolder {
    explicit MadeFolder(const std::string& made) : path(made), registered(made) {}
    std::string path;
    UnfinishedName registered;
  };
  std::vector<std::unique_ptr<MadeFolder>> folders_;
  std::vector<std::unique_ptr<OutputFile>> files_;
};

}  // namespace scotopic

#include "io/atomic/output_set.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace scotopic {

namespace fs = std::filesystem;

OutputSet::~OutputSet() {
  files_.clear();
  // Those that hold something now stay.
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) rmdir((*folder)->path.c_str());
}

void OutputSet::make_folder(const std::string& path) {
  std::vector<std::string> missing;
  fs::path at = fs::path(path).has_filename() ? fs::path(path) : fs::path(path).parent_path();
  for (std::error_code error; !at.empty() && !fs::exists(at, error); at = at.parent_path())
    missing.push_back(at.string());
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
    const SignalsHeld held;
    if (mkdir(folder->c_str(), 0777) == 0)
      folders_.push_back(std::make_unique<MadeFolder>(*folder));
    else if (errno != EEXIST)  // another program may have been faster
      throw Error(ExitCode::output, path, std::string("cannot be made: ") + std::strerror(errno));
  }
}

OutputFile& OutputSet::open(const std::string& path) {
  return *files_.emplace_back(std::make_unique<OutputFile>(path));
}

void OutputSet::write(OutputFile& file, const std::string& text) {
  file.write(text.data(), text.size());
  file.complete();
  std::string back(text.size(), '\0');
  file.seek(0);
  back.resize(file.read(back.data(), back.size()));
  if (back != text)
    throw Error(ExitCode::output, file.path(), "what was written reads back as something else");
}

OutputFile& OutputSet::add(const std::string& path, const std::string& text) {
  OutputFile& file = open(path);
  write(file, text);
  return file;
}

void OutputSet::commit() {
  for (const auto& file : files_) file->publish();
}

}  // namespace scotopic

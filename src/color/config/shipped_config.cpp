#include "color/config/shipped_config.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace scotopic {
namespace {

/// Of the program, and of the module that holds this code where a host has loaded one.
std::vector<fs::path> own_folders() {
  static const char here = 0;
  std::error_code none;
  std::vector<fs::path> out = {fs::read_symlink("/proc/self/exe", none).parent_path()};
  Dl_info module = {};
  if (dladdr(&here, &module) != 0 && module.dli_fname)
    out.push_back(fs::absolute(module.dli_fname, none).parent_path());
  return out;
}

}  // namespace

std::string shipped_config_file() {
  constexpr const char* below = "scotopic/ocio_config/config.ocio";
  std::vector<fs::path> files;
  for (const fs::path& folder : own_folders()) {
    files.push_back(folder / "../share" / below);
    files.push_back(folder / "../../../../share" / below);
    files.push_back(folder / "../../../../ocio_config/config.ocio");
  }
  files.insert(files.begin() + 1, SCOTOPIC_SHARE_FOLDER "/ocio_config/config.ocio");
  std::error_code none;
  for (const fs::path& file : files)
    if (fs::is_regular_file(file, none)) return file.lexically_normal().string();
  return "";
}

}  // namespace scotopic

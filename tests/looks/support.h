// What the tests of bakes share: parameters with defaults, and files that go away.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "stages/shared/parameters.h"
#include "color/primaries.h"

namespace scotopic::test {

inline AppearanceParameters adapted_to(double adaptation, const char* gamut = "rec709",
                                       Model model = Model::filament2021) {
  AppearanceParameters p;
  p.model = model;
  p.adaptation = adaptation;
  p.white_luminance = adaptation / 0.18;
  p.xyz_from_rgb = gamut_xyz_matrix(gamut).value();
  p.xyz_from_gamut = p.xyz_from_rgb;
  return p;
}

/// A folder of this process's own, removed with all that is in it.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("scotopic_bake_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name = "") const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

}  // namespace scotopic::test

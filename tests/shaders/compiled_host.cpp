// Shaders of C's family through a header that stands for the host, as a library of this process.
#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "shaders/hosts.h"

namespace scotopic::test {
namespace {

namespace fs = std::filesystem;

std::string text_in(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A folder of its own, gone with it.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "scotopic_shader_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no folder");
    path_ = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

class CompiledHost : public Host {
 public:
  CompiledHost(const std::string& compiler, const std::string& runner, const std::string& text) {
    std::ofstream(folder_ / "shader.txt") << text;
    const std::string command = fmt::format(
        "{} -std=c++17 -O1 -fPIC -shared -ffp-contract=off -Wall -Werror -Wdouble-promotion -Wfloat-conversion "
        "-I{}/tests/shaders/shims -DSHADER='\"{}\"' {}/tests/shaders/shims/{} -o {} >{} 2>&1",
        compiler, SCOTOPIC_SOURCE_DIR, (folder_ / "shader.txt").string(), SCOTOPIC_SOURCE_DIR, runner,
        (folder_ / "shader.so").string(), (folder_ / "said").string());
    if (std::system(command.c_str()) != 0) throw std::runtime_error(text_in(folder_ / "said"));
    library_ = dlopen((folder_ / "shader.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library_) throw std::runtime_error(dlerror());
    run_ = reinterpret_cast<Run>(dlsym(library_, "run"));
    if (!run_) throw std::runtime_error(dlerror());
  }
  ~CompiledHost() override {
    if (library_) dlclose(library_);
  }

  Pixels show(const shaders::SliderValues& sliders, const Pixels& pixels) override {
    for (std::size_t i = 0; i < sliders.size(); ++i) {
      const std::string name(shaders::slider_texts[i].name);
      set(name, sliders[i]);
      if (sliders[i] > 0) set("log10_" + name, std::log10(sliders[i]));
    }
    Pixels out(pixels.size());
    run_(pixels.data(), out.data(), pixels.size() / 3);
    return out;
  }

 private:
  using Run = void (*)(const float*, float*, std::size_t);

  void set(const std::string& name, double value) {
    if (auto* const slider = static_cast<float*>(dlsym(library_, name.c_str()))) *slider = static_cast<float>(value);
  }

  Folder folder_;
  void* library_ = nullptr;
  Run run_ = nullptr;
};

}  // namespace

std::unique_ptr<Host> dctl_host(const std::string& compiler, const std::string& text) {
  return std::make_unique<CompiledHost>(compiler, "run_dctl.cpp", text);
}

bool have(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace scotopic::test

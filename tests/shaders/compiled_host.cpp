// Shaders of C's family through a header that stands for the host, as a library of this process.
#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
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
  const fs::path& path() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

class CompiledHost : public Host {
 public:
  CompiledHost(const std::string& compiler, const std::string& runner, const std::string& text) {
    std::ofstream(folder_ / "shader.txt") << text;
    const std::string command = fmt::format(
        "{} -std=c++17 -O1 -fPIC -shared -ffp-contract=off -Wall -Werror -Wdouble-promotion "
        "-Wfloat-conversion "
        "-I{}/tests/shaders/shims -DSHADER='\"{}\"' {}/tests/shaders/shims/{} -o {} >{} 2>&1",
        compiler, SCOTOPIC_SOURCE_DIR, (folder_ / "shader.txt").string(), SCOTOPIC_SOURCE_DIR, runner,
        (folder_ / "shader.so").string(), (folder_ / "said").string());
    if (std::system(command.c_str()) != 0) throw std::runtime_error(text_in(folder_ / "said"));
    library_ = dlopen((folder_ / "shader.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library_) throw std::runtime_error(dlerror());
    run_ = reinterpret_cast<Run>(dlsym(library_, "run"));
    slider_ = reinterpret_cast<FindSlider>(dlsym(library_, "slider"));
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
  using FindSlider = float* (*)(const char*);

  // Sliders are what the shim finds, or variables of their names.
  void set(const std::string& name, double value) {
    float* const slider =
        slider_ ? slider_(name.c_str()) : static_cast<float*>(dlsym(library_, name.c_str()));
    if (slider) *slider = static_cast<float>(value);
  }

  Folder folder_;
  void* library_ = nullptr;
  Run run_ = nullptr;
  FindSlider slider_ = nullptr;
};

}  // namespace

std::unique_ptr<Host> dctl_host(const std::string& compiler, const std::string& text) {
  return std::make_unique<CompiledHost>(compiler, "run_dctl.cpp", text);
}

std::unique_ptr<Host> blink_host(const std::string& compiler, const std::string& text) {
  return std::make_unique<CompiledHost>(compiler, "run_blink.cpp", text);
}

std::unique_ptr<Host> osl_host(const std::string& compiler, const std::string& text) {
  // Parameters, "float name = value [[ ... ]],", become variables, and the rest a function of the colours.
  static const std::regex parameter(R"(\n  float (\w+) = ([^ ]+) \[\[[^\]]*\]\],)");
  std::string variables;
  for (std::sregex_iterator p(text.begin(), text.end(), parameter), end; p != end; ++p)
    variables +=
        fmt::format("extern \"C\" {{ float {} = static_cast<float>({}); }}\n", (*p)[1].str(), (*p)[2].str());
  std::string body = std::regex_replace(text, parameter, "");
  const std::string black = R"(color\(0.0, 0.0, 0.0\))";
  body = std::regex_replace(body,
                            std::regex(R"(shader scotopic\(\s*color Cin = )" + black +
                                       R"(,\s*output color Cout = )" + black + R"(\))"),
                            "static void scotopic(const color& Cin, color& Cout)");
  // Numbers of OSL are floats.
  body = std::regex_replace(
      body, std::regex(R"(([^\w.])(\d+(\.\d+)?(e[-+]?\d+)?|\d+\.\d*(e[-+]?\d+)?)(?![\w.\]]))"), "$1$2f");
  return std::make_unique<CompiledHost>(compiler, "run_osl.cpp", variables + body);
}

std::unique_ptr<Host> hlsl_host(const std::string& text) {
  const Folder folder;
  std::ofstream(folder / "shader.hlsl") << text;
  const std::string at = folder.path().string();
  const std::string command = fmt::format(
      "cd {} && {{ glslangValidator -D -V -S frag -e main -o shader.spv shader.hlsl && "
      "spirv-cross shader.spv --version 330 --no-es --glsl-emit-ubo-as-plain-uniforms --output shader.glsl; "
      "}} >said 2>&1",
      at);
  if (std::system(command.c_str()) != 0) throw std::runtime_error(text_in(folder / "said"));
  return glsl_host(text_in(folder / "shader.glsl"));
}

bool have(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace scotopic::test

// Shaders as their hosts run them: compiled, with sliders that can be set.
#pragma once

#include <memory>
#include <string>

#include "shaders/cases.h"

namespace scotopic::test {

/// A shader that has been compiled. Throws std::runtime_error with the compiler's own words where it cannot
/// be.
class Host {
 public:
  virtual ~Host() = default;
  /// The pixels, seen through it.
  virtual Pixels show(const shaders::SliderValues& sliders, const Pixels& pixels) = 0;
};

/// A DCTL as C++, by `compiler`, with all warnings as errors.
std::unique_ptr<Host> dctl_host(const std::string& compiler, const std::string& text);

/// A Blink kernel likewise.
std::unique_ptr<Host> blink_host(const std::string& compiler, const std::string& text);

/// The body of an OSL shader likewise: its arithmetic, not its compiler.
std::unique_ptr<Host> osl_host(const std::string& compiler, const std::string& text);

/// HLSL by glslangValidator to SPIR-V, that by spirv-cross to GLSL, that as below.
std::unique_ptr<Host> hlsl_host(const std::string& text);

/// GLSL on Mesa's llvmpipe, through EGL without a window.
std::unique_ptr<Host> glsl_host(const std::string& text);

/// Whether a program is on the path.
bool have(const std::string& program);

}  // namespace scotopic::test

// GLSL as Flame runs it: a texture in, a full-screen quad, a picture out; on llvmpipe, without a window.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "shaders/hosts.h"

namespace scotopic::test {
namespace {

void require(bool done, const std::string& what) {
  if (!done) throw std::runtime_error(what);
}

/// One context for the process.
void use_context() {
  static const bool made = [] {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    const auto display_of =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    require(display_of != nullptr, "EGL knows no platforms");
    const EGLDisplay display = display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(eglInitialize(display, nullptr, nullptr) && eglBindAPI(EGL_OPENGL_API), "no EGL");
    const EGLint wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    require(eglChooseConfig(display, wish, &config, 1, &count) && count == 1, "no EGL config");
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
    require(context != EGL_NO_CONTEXT, "no OpenGL context");
    return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
  }();
  require(made, "no OpenGL context");
}

GLuint float_texture(GLsizei width, GLsizei height, const float* rgba) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, rgba);
  return texture;
}

class GlslHost : public Host {
 public:
  explicit GlslHost(const std::string& text) {
    use_context();
    const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER);
    const char* const source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    program_ = glCreateProgram();
    glAttachShader(program_, shader);
    glLinkProgram(program_);
    glDeleteShader(shader);
    GLint linked = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &linked);
    std::string said(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program_, static_cast<GLsizei>(said.size()), &length, said.data());
    require(linked != 0, "GLSL: " + said.substr(0, static_cast<std::size_t>(length)));
  }
  ~GlslHost() override { glDeleteProgram(program_); }

  Pixels show(const shaders::SliderValues& sliders, const Pixels& pixels) override {
    const std::size_t count = pixels.size() / 3;
    const GLsizei height = static_cast<GLsizei>((count + width - 1) / width);
    std::vector<float> rgba(static_cast<std::size_t>(width * height) * 4, 0.25F);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c) rgba[4 * i + c] = pixels[3 * i + c];
    render(sliders, rgba, height);
    Pixels out;
    for (std::size_t i = 0; i < count; ++i) {
      require(rgba[4 * i + 3] == 0.25F, "alpha has changed");
      out.insert(out.end(), {rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]});
    }
    return out;
  }

 private:
  static constexpr GLsizei width = 256;

  /// By its name, alone or behind that of a block: "adaptation", "block.adaptation".
  void set(const std::string& wanted, double value) const {
    GLint count = 0;
    glGetProgramiv(program_, GL_ACTIVE_UNIFORMS, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
      char text[128] = {};
      GLint size = 0;
      GLenum type = 0;
      glGetActiveUniform(program_, i, sizeof text, nullptr, &size, &type, text);
      const std::string name = text;
      if (type == GL_FLOAT && name.substr(name.rfind('.') + 1) == wanted)
        glUniform1f(glGetUniformLocation(program_, text), static_cast<float>(value));
    }
  }

  void render(const shaders::SliderValues& sliders, std::vector<float>& rgba, GLsizei height) const {
    const GLuint target = float_texture(width, height, nullptr);
    const GLuint source = float_texture(width, height, rgba.data());
    GLuint frame = 0;
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    require(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "no float frame buffer");
    glUseProgram(program_);
    for (std::size_t i = 0; i < sliders.size(); ++i) {
      const std::string name(shaders::slider_texts[i].name);
      set(name, sliders[i]);
      if (sliders[i] > 0) set("log10_" + name, std::log10(sliders[i]));
    }
    set("adsk_result_w", width);
    set("adsk_result_h", height);
    glViewport(0, 0, width, height);
    glRectf(-1, -1, 1, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
    require(glGetError() == GL_NO_ERROR, "an OpenGL error");
    glDeleteFramebuffers(1, &frame);
    glDeleteTextures(1, &source);
    glDeleteTextures(1, &target);
  }

  GLuint program_ = 0;
};

}  // namespace

std::unique_ptr<Host> glsl_host(const std::string& text) { return std::make_unique<GlslHost>(text); }

}  // namespace scotopic::test

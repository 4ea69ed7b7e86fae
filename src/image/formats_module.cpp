#include "image/formats_module.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>

#include "image/error.h"

namespace scotopic {
namespace {

/// One of the libraries that OpenImageIO brings ends the program where it finds no free descriptor.
bool has_descriptors() {
  std::array<int, 16> probes;
  probes.fill(-1);
  for (int& probe : probes) probe = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool all = probes.back() >= 0;
  for (const int probe : probes)
    if (probe >= 0) close(probe);
  return all;
}

const FormatsModule* load() {
  void* module = dlopen("scotopic_formats.so", RTLD_NOW | RTLD_LOCAL);
  if (!module) module = dlopen(SCOTOPIC_MODULE_FOLDER "/scotopic_formats.so", RTLD_NOW | RTLD_LOCAL);
  return module ? static_cast<const FormatsModule*>(dlsym(module, "scotopic_formats")) : nullptr;
}

}  // namespace

const FormatsModule& formats_module(const std::string& file) {
  if (!has_descriptors())
    throw Error(ExitCode::limit, file, "too few files can be opened to load what knows TIFF, PNG, JPEG and HDR");
  static const FormatsModule* const module = load();
  if (!module) {
    const char* reason = dlerror();
    throw Error(ExitCode::internal, file,
                std::string("cannot load scotopic_formats.so, which knows TIFF, PNG, JPEG and HDR: ") +
                    (reason ? reason : "not found"));
  }
  return *module;
}

}  // namespace scotopic

#include "image/formats_module.h"

#include <dlfcn.h>

#include "image/error.h"

namespace scotopic {
namespace {

const FormatsModule* load() {
  void* module = dlopen("scotopic_formats.so", RTLD_NOW | RTLD_LOCAL);
  if (!module) module = dlopen(SCOTOPIC_MODULE_FOLDER "/scotopic_formats.so", RTLD_NOW | RTLD_LOCAL);
  return module ? static_cast<const FormatsModule*>(dlsym(module, "scotopic_formats")) : nullptr;
}

}  // namespace

const FormatsModule& formats_module(const std::string& file) {
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

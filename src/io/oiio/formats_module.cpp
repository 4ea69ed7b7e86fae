#include "io/oiio/formats_module.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstddef>

#include "base/error.h"

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

/// Others do where memory ends while they are loaded: they map some 450 MiB.
bool has_address_space() {
  constexpr std::size_t size = std::size_t{512} << 20;
  void* const probe = mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (probe == MAP_FAILED) return false;
  munmap(probe, size);
  return true;
}

/// The libraries that OpenImageIO brings heed variables of their own while they are loaded; for some they
/// print, or end the program. In here there are none.
class EmptyEnvironment {
 public:
  EmptyEnvironment() { environ = none_; }
  ~EmptyEnvironment() { environ = kept_; }
  EmptyEnvironment(const EmptyEnvironment&) = delete;
  EmptyEnvironment& operator=(const EmptyEnvironment&) = delete;

 private:
  char* none_[1] = {nullptr};
  char** const kept_ = environ;
};

const FormatsModule* load(const std::string& file) {
  const auto refuse = [&](ExitCode code, const std::string& reason) {
    throw Error(code, file,
                "cannot load scotopic_formats.so, which knows TIFF, PNG, JPEG and HDR: " + reason);
  };
  if (!has_descriptors()) refuse(ExitCode::limit, "too few files can be opened");
  if (!has_address_space()) refuse(ExitCode::limit, "512 MiB of address space are not to be had (ulimit -v)");
  const EmptyEnvironment loading;
  std::string reason;
  for (const char* name : {"scotopic_formats.so", SCOTOPIC_MODULE_FOLDER "/scotopic_formats.so"}) {
    if (void* const module = dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
      const auto* const formats = static_cast<const FormatsModule*>(dlsym(module, "scotopic_formats"));
      formats->prepare();
      return formats;
    }
    const char* const said = dlerror();
    reason += (reason.empty() ? "" : "; ") + std::string(said ? said : "no reason given");
  }
  refuse(ExitCode::internal, reason);
  return nullptr;
}

}  // namespace

const FormatsModule& formats_module(const std::string& file) {
  static const FormatsModule* const module = load(file);
  return *module;
}

}  // namespace scotopic

#include "io/exr/open_exr.h"

#include <OpenEXR/OpenEXRConfig.h>

#define SCOTOPIC_EXR_HAS_CONTEXTS \
  (OPENEXR_VERSION_MAJOR > 3 || (OPENEXR_VERSION_MAJOR == 3 && OPENEXR_VERSION_MINOR >= 3))

#if SCOTOPIC_EXR_HAS_CONTEXTS
#include <OpenEXR/ImfContextInit.h>
#endif

namespace scotopic {

#if SCOTOPIC_EXR_HAS_CONTEXTS

namespace {

/// What is said here is thrown as well.
void say_nothing(exr_const_context_t, exr_result_t, const char*) {}

}  // namespace

std::unique_ptr<Imf::MultiPartInputFile> open_exr(const std::string& file) {
  return std::make_unique<Imf::MultiPartInputFile>(file.c_str(),
                                                   Imf::ContextInitializer().setErrorHandler(say_nothing));
}

std::unique_ptr<Imf::MultiPartInputFile> open_exr(Imf::IStream& stream) {
  return std::make_unique<Imf::MultiPartInputFile>(
      stream.fileName(), Imf::ContextInitializer().setErrorHandler(say_nothing).setInputStream(&stream));
}

#else

std::unique_ptr<Imf::MultiPartInputFile> open_exr(const std::string& file) {
  return std::make_unique<Imf::MultiPartInputFile>(file.c_str());
}

std::unique_ptr<Imf::MultiPartInputFile> open_exr(Imf::IStream& stream) {
  return std::make_unique<Imf::MultiPartInputFile>(stream);
}

#endif

}  // namespace scotopic

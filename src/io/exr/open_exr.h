// OpenEXR's files, opened so that what OpenEXR finds wrong is thrown and nothing is printed.
#pragma once

#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <memory>
#include <string>

namespace scotopic {

/// From OpenEXR 3.3 on its C library prints each fault on stderr before the C++ library throws it.
std::unique_ptr<Imf::MultiPartInputFile> open_exr(const std::string& file);
std::unique_ptr<Imf::MultiPartInputFile> open_exr(Imf::IStream& stream);

}  // namespace scotopic

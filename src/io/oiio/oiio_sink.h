// TIFF, PNG and JPEG output through OpenImageIO; see open_sink().
#pragma once

#include "io/pixel_sink.h"

namespace scotopic {

/// TIFF or PNG; see open_sink().
std::unique_ptr<PixelSink> open_oiio_sink(const std::string& format, OutputFile& file, PixelSource& source,
                                          const std::vector<OutputSubimage>& subimages);

}  // namespace scotopic

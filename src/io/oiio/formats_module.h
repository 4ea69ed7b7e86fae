// The formats that OpenImageIO reads and writes, in a module that is loaded when a file needs it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/pixel_sink.h"
#include "io/pixel_source.h"

namespace scotopic {

/// What the module offers; it exports one, named scotopic_formats.
struct FormatsModule {
  /// Once, before the others: what is set for all of the process.
  void (*prepare)();
  std::unique_ptr<PixelSource> (*open_source)(const std::string& file, const std::string& format,
                                              const Limits& limits);
  std::unique_ptr<PixelSink> (*open_sink)(const std::string& format, OutputFile& file, PixelSource& source,
                                          const std::vector<OutputSubimage>& subimages);
};

/// Loads it once, from the program's run path or the folder it was installed to. Error(internal), for `file`,
/// if it is not there.
const FormatsModule& formats_module(const std::string& file);

}  // namespace scotopic

#include "io/pixel_sink.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/error.h"
#include "io/oiio/formats_module.h"

namespace scotopic {

std::string output_format(const std::string& path) {
  static const std::map<std::string, std::string> formats = {{".exr", "openexr"}, {".tif", "tiff"},
                                                             {".tiff", "tiff"},   {".png", "png"},
                                                             {".jpg", "jpeg"},    {".jpeg", "jpeg"}};
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto found = formats.find(extension);
  if (found == formats.end())
    throw Error(ExitCode::usage, path, "output must be named .exr, .tif, .tiff, .png, .jpg or .jpeg");
  return found->second;
}

const std::vector<PixelType>& pixel_types_of(const std::string& format) {
  static const std::map<std::string, std::vector<PixelType>> types = {
      {"openexr", {PixelType::half, PixelType::float32}},
      {"tiff", {PixelType::uint8, PixelType::uint16, PixelType::float32}},
      {"png", {PixelType::uint8, PixelType::uint16}},
      {"jpeg", {PixelType::uint8}}};
  return types.at(format);
}

std::unique_ptr<PixelSink> open_sink(const std::string& format, OutputFile& file, PixelSource& source,
                                     const std::vector<OutputSubimage>& subimages) {
  return format == "openexr" ? open_exr_sink(file, source, subimages)
                             : formats_module(file.path()).open_sink(format, file, source, subimages);
}

}  // namespace scotopic

// TIFF, PNG, JPEG and HDR files through OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include "io/pixel_source.h"

namespace scotopic {

/// One picture for each page (TIFF), else one.
class OiioSource : public PixelSource {
 public:
  /// Reads the header. Throws Error(input) or Error(limit).
  OiioSource(const std::string& file, const std::string& format, const Limits& limits);

  void read(std::size_t index, int y0, int rows, Band& band) override;
  std::vector<Attribute> attributes(std::size_t index) const override;

  /// What OpenImageIO says of a picture.
  const OIIO::ImageSpec& spec(std::size_t index) const { return specs_[index]; }

 private:
  void add_picture(int page, const OIIO::ImageSpec& spec);

  std::unique_ptr<OIIO::ImageInput> input_;
  std::vector<OIIO::ImageSpec> specs_;  // one for each picture
};

/// A file whose format is known already: tiff, png, jpeg, hdr.
std::unique_ptr<PixelSource> open_oiio_source(const std::string& file, const std::string& format,
                                              const Limits& limits);

}  // namespace scotopic

// TIFF, PNG, JPEG and HDR files through OpenImageIO.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>

#include "io/oiio/oriented_page.h"
#include "io/pixel_source.h"
#include "io/scan/image_scan.h"

namespace scotopic {

/// One subimage for each page (TIFF), else one; upright, whichever way it is stored.
class OiioSource : public PixelSource {
 public:
  /// Reads the header. Throws Error(input) or Error(limit).
  OiioSource(const std::string& file, const std::string& format, const Limits& limits);

  void read(std::size_t index, int y0, int rows, Band& band) override;
  std::vector<Attribute> attributes(std::size_t index) const override;

  /// What OpenImageIO says of a subimage.
  const OIIO::ImageSpec& spec(std::size_t index) const { return specs_[index]; }

 private:
  void read_xyze_as_rgbe(std::uint64_t at);
  void add_subimage(int page, const OIIO::ImageSpec& spec);
  void set_colour(Subimage& subimage, ImageScan& scan) const;
  void set_upright(Subimage& subimage, const ImageScan& scan) const;
  void read_stored(std::size_t index, int y0, int rows, std::byte* out);
  void read_upright(std::size_t index, int y0, int rows, std::byte* out);
  void correct_exposure(const ImageScan& scan, Band& band) const;

  std::unique_ptr<OIIO::Filesystem::IOProxy> proxy_;  // outlives the input
  std::unique_ptr<OIIO::ImageInput> input_;
  std::vector<OIIO::ImageSpec> specs_;  // one for each subimage
  std::vector<ImageScan> scans_;        // likewise
  StoredPage page_;                     // the one that is being turned
  std::size_t page_index_ = SIZE_MAX;
};

/// A file whose format is known already: tiff, png, jpeg, hdr.
std::unique_ptr<PixelSource> open_oiio_source(const std::string& file, const std::string& format,
                                              const Limits& limits);

}  // namespace scotopic

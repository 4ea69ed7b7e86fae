// What TIFF, PNG, JPEG and HDR files say beside their pixels, read by ourselves: OpenImageIO knows less of
// it, and some of it must be looked through before its decoders are let at it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "color/file/colour_tags.h"

namespace scotopic {

/// Of one picture (a page of a TIFF, else the file).
struct ImageScan {
  ColourTags colour;
  std::int64_t width = 0, height = 0;         ///< as PNG and HDR say them; 0: not looked for
  int orientation = 1;                        ///< Exif's 1 to 8
  double exposure = 1;                        ///< pixels are this times the light (Radiance HDR), and
  std::array<double, 3> correction{1, 1, 1};  ///< these, of each channel
  double pixel_aspect = 1;         ///< width over height of a pixel: PIXASPECT, resolutions that differ
  std::uint64_t xyze_at = 0;       ///< channels are X, Y, Z (Radiance xyze): where the file says it
  bool gain_map = false;           ///< a second picture makes an HDR one of it
  int images_behind = 0;           ///< in a JPEG's Multi-Picture Format
  bool panorama = false;           ///< all of a lat-long one (GPano)
  std::vector<std::string> notes;  ///< what else is to be said
};

/// Throws Error(input) for a damaged or hostile ICC profile or XMP packet, and for pixels that are no RGB
/// (CMYK, Lab, LogLuv). What is wrong in other ways is left to the format's own library to say.
std::vector<ImageScan> scan_image(const std::string& file, const std::string& format);

/// Each of a format; `file` is for errors.
ImageScan scan_png(const std::string& file);
ImageScan scan_jpeg(const std::string& file);
std::vector<ImageScan> scan_tiff(const std::string& file);
ImageScan scan_hdr(const std::string& file);

/// Orientation and colours of an Exif block (a TIFF of its own), as far as it goes.
void read_exif(std::span<const std::byte> block, ImageScan& scan);

/// Where the images behind the first begin, by the index of a Multi-Picture Format (a TIFF of its own).
std::vector<std::uint64_t> offsets_of_images(std::span<const std::byte> index);

/// Throws Error(input) for a damaged profile, else keeps it.
void keep_profile(std::vector<std::byte> profile, const std::string& file, ImageScan& scan);

/// Throws Error(input) for XML whose elements nest deeper than 64 (recursion would end the stack); sets
/// gain_map and panorama.
void check_xmp(std::span<const std::byte> packet, const std::string& file, ImageScan& scan);

}  // namespace scotopic

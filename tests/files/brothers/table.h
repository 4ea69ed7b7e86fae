// Tables of files and what the program makes of each: pixels, one line of refusal, or what it says.
#pragma once

#include <string>
#include <vector>

#include "files/made_files.h"

namespace scotopic::test {

/// What becomes of a file. Refused where `refusal` is not empty; else pixel (0, 0) is `light` in linear
/// BT.709.
struct Expected {
  std::string what;  ///< the row
  Rgb light{};
  double tolerance = 1e-4;
  std::string says{};                                   ///< a part of a line
  std::string refusal{};                                ///< a part of the only line
  std::vector<std::string> channels = {"R", "G", "B"};  ///< as they are written
};

/// Runs apply in daylight and compares.
void expect_row(const std::string& file, const Expected& row);

/// A field of a TIFF directory: SHORT 3, LONG 4, RATIONAL 5, FLOAT 11, DOUBLE 12.
struct TiffField {
  std::uint32_t tag = 0, type = 3;
  std::vector<double> values;
};
/// A little-endian directory at `at` of a file, and what its values need, which stands behind it.
std::string tiff_directory(std::vector<TiffField> fields, std::uint32_t at);

/// Samples of 4 x 4 pixels of one value.
struct TiffSamples {
  std::vector<double> pixel;  ///< codes, or floats
  std::uint32_t bits = 8;
  std::uint32_t format = 1;       ///< SampleFormat: 1 unsigned, 3 float
  std::uint32_t photometric = 2;  ///< RGB; 0 and 1: grey
};
std::string flat_tiff(const TiffSamples& samples, std::vector<TiffField> more = {});

/// An Exif block: IFD0, and its Exif directory.
std::string exif_block(std::vector<TiffField> main, std::vector<TiffField> exif);
/// A JPEG with a marker segment ("\xe1" and so on) behind SOI.
std::string with_segment(const std::string& jpeg, char marker, const std::string& body);

/// IEC 61966-2-1's, of a code of 8 bits.
double srgb_light(double code);

/// What the codes 128, 64, 200 mean as they are, and as sRGB's.
inline const Rgb as_codes = {128 / 255.0, 64 / 255.0, 200 / 255.0};
inline const Rgb in_srgb = {srgb_light(128), srgb_light(64), srgb_light(200)};

}  // namespace scotopic::test

// Pages of a TIFF (revision 6.0).
#include <cmath>
#include <string>

#include "base/error.h"
#include "io/scan/exif_scan.h"
#include "io/scan/file_bytes.h"
#include "io/scan/image_scan.h"
#include "io/scan/tiff_directories.h"

namespace scotopic {
namespace {

using Field = TiffDirectories::Field;

constexpr std::uint64_t most_pages = 65536;

enum TiffTag : std::uint64_t {
  subfile_type = 254,
  bits_per_sample = 258,
  photometric = 262,
  samples_per_pixel = 277,
  x_resolution = 282,
  y_resolution = 283,
  sub_directories = 330,
  extra_samples = 338,
  sample_format = 339,
  xmp = 700,
  icc_profile = 34675,
  dng_version = 50706,
};

/// Numbers of a page that decide how its samples are read, as they are where the tag is missing.
struct Page {
  std::int64_t bits = 1, photometric = 1, samples = 1, format = 1, subfile = 0;
  double x_resolution = 1, y_resolution = 1;
  bool extra_stated = false, raw = false, has_pages_below = false;
};

Page page_of(const TiffDirectories& tiff, const std::vector<Field>& fields) {
  Page page;
  for (const Field& field : fields) {
    if (field.tag == subfile_type) page.subfile = tiff.integer(field);
    if (field.tag == bits_per_sample) page.bits = tiff.integer(field);
    if (field.tag == photometric) page.photometric = tiff.integer(field);
    if (field.tag == samples_per_pixel) page.samples = tiff.integer(field);
    if (field.tag == sample_format) page.format = tiff.integer(field);
    if (field.tag == x_resolution) page.x_resolution = tiff.value(field);
    if (field.tag == y_resolution) page.y_resolution = tiff.value(field);
    page.extra_stated = page.extra_stated || field.tag == extra_samples;
    page.raw = page.raw || field.tag == dng_version;
    page.has_pages_below = page.has_pages_below || field.tag == sub_directories;
  }
  return page;
}

void require_rgb(std::int64_t photometric, const std::string& file) {
  const char* const what = photometric == 5                               ? "CMYK"
                           : photometric >= 8 && photometric <= 10        ? "CIE Lab"
                           : photometric == 32844 || photometric == 32845 ? "LogLuv"
                                                                          : nullptr;
  if (what) throw Error(ExitCode::input, file, std::string("holds ") + what + ", not RGB: convert it first");
}

[[noreturn]] void fail_raw(const std::string& file) {
  throw Error(ExitCode::input, file, "is a camera's raw file: develop it first, to linear TIFF or OpenEXR");
}

/// A raw file is a TIFF whose first directory is a thumbnail, or a mosaic.
void refuse_raw(const Page& page, const std::string& file) {
  constexpr std::int64_t mosaic = 32803, linear_raw = 34892, reduced = 1;
  const bool small = (page.subfile & reduced) != 0;
  if (page.raw || page.photometric == mosaic || page.photometric == linear_raw ||
      (small && page.has_pages_below))
    fail_raw(file);
}

/// What OpenImageIO reads otherwise than the page says: grey whose zero is white it turns round where it is
/// of 8 bits or less, of more it leaves it; of floats of 24 bits and of complex numbers it makes others.
void refuse_misread(const Page& page, const std::string& file) {
  constexpr std::int64_t floats = 3, complex_integers = 5, complex_floats = 6;
  if (page.photometric == 0 && page.bits > 8)
    throw Error(ExitCode::input, file, "holds grey of more than 8 bits whose 0 is white: invert it first");
  if (page.format == floats && page.bits != 16 && page.bits != 32 && page.bits != 64)
    throw Error(ExitCode::input, file,
                "holds floats of " + std::to_string(page.bits) + " bits; 16 and 32 can be read");
  if (page.format == complex_integers || page.format == complex_floats)
    throw Error(ExitCode::input, file, "holds complex numbers, not colours");
}

/// Width over height of a pixel, from how many there are to a length.
double page_aspect(const Page& page) {
  const double aspect = page.y_resolution / page.x_resolution;
  return std::isfinite(aspect) && aspect > 0 ? aspect : 1.0;
}

ImageScan scan_directory(const TiffDirectories& tiff, const std::vector<Field>& fields, const Page& page,
                         const std::string& file) {
  constexpr std::int64_t rgb = 2;
  require_rgb(page.photometric, file);
  refuse_misread(page, file);
  ImageScan scan;
  scan.pixel_aspect = page_aspect(page);
  read_colorimetry(tiff, fields, static_cast<std::uint64_t>(page.bits), scan);
  for (const Field& field : fields) {
    if (field.tag == xmp) check_xmp(tiff.bytes(field), file, scan);
    if (field.tag == icc_profile) keep_profile(tiff.bytes(field), file, scan);
  }
  if (page.photometric == rgb && page.samples == 4 && !page.extra_stated)
    scan.notes.emplace_back("its fourth channel is of no stated kind: it is taken for alpha, multiplied in");
  return scan;
}

}  // namespace

std::vector<ImageScan> scan_tiff(const std::string& file) {
  FileBytes bytes(file);
  const TiffDirectories tiff([&](std::uint64_t at, std::uint64_t count) { return bytes.at(at, count); });
  constexpr std::uint64_t canon = 0x4352;  // "CR" of a CR2; no directory is that long
  if (number_at(bytes.at(8, 2), 0, 2, true) == canon) fail_raw(file);
  std::vector<ImageScan> pages;
  for (std::uint64_t at = tiff.first(), next = 0; at != 0 && pages.size() < most_pages; at = next) {
    const std::vector<Field> fields = tiff.fields(at, next);
    const Page page = page_of(tiff, fields);
    if (pages.empty()) refuse_raw(page, file);
    pages.push_back(scan_directory(tiff, fields, page, file));
    if (next <= at && pages.size() > 1024) break;  // goes round
  }
  return pages;
}

}  // namespace scotopic

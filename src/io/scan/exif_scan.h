// What TIFF and Exif have in common: a picture's colorimetry and orientation, in tags of the same numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "io/scan/image_scan.h"
#include "io/scan/tiff_directories.h"

namespace scotopic {

/// Orientation, WhitePoint, PrimaryChromaticities, TransferFunction of samples of `bits`, and the Exif
/// directory (ColorSpace, Gamma, the interoperability index).
void read_colorimetry(const TiffDirectories& tiff, const std::vector<TiffDirectories::Field>& fields,
                      std::uint64_t bits, ImageScan& scan);

}  // namespace scotopic

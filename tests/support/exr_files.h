// OpenEXR files for tests, filled with random bits: NaNs of every payload, infinities, denormals and all.
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfLineOrder.h>
#include <OpenEXR/ImfTileDescription.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/apply_image.h"
#include "io/subimage.h"

namespace scotopic::test {

struct TestPart {
  std::string name;
  Window data{0, 0, 37, 50};
  Window display{0, 0, 37, 50};
  std::vector<Channel> channels;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  std::optional<Imf::TileDescription> tiles;
  bool finite = false;  ///< values of a picture, .001 to 10, in place of any bits
};

/// The bits of one pixel: the same for every call.
std::uint32_t pixel_bits(const TestPart& part, std::size_t channel, int x, int y);

/// All resolutions filled by pixel_bits; attributes of several types in each header.
void write_exr(const std::string& file, const std::vector<TestPart>& parts);

/// Bits of a channel of a resolution, row by row; uint32 for every type.
std::vector<std::uint32_t> read_bits(const std::string& file, int part, int level_x, int level_y,
                                     const std::string& channel);

/// A file of the test's own, in a folder that is there.
std::string temporary(const std::string& name);
std::string file_bytes(const std::string& file);

/// The operator at `adaptation`, unit 1; the layout that was used.
ImageLayout run_operator(const std::string& in, const std::string& out, double adaptation,
                         const ImageRequest& request = {});

}  // namespace scotopic::test

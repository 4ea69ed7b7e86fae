// OpenEXR files through our readers: headers and bodies, colour, spectral and receptor channels.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <algorithm>

#include "fuzz/target.h"
#include "base/error.h"
#include "io/pixel_source.h"
#include "io/spectral/spectral_source.h"

namespace scotopic::fuzz {
namespace {

constexpr int width = 9, height = 7;

Bytes file_of(const std::vector<std::string>& channels, Imf::Compression compression, Imf::PixelType type,
              bool tiled) {
  Imf::Header header(width, height);
  header.compression() = compression;
  Imf::addWhiteLuminance(header, 100);
  for (const auto& name : channels) header.channels().insert(name, Imf::Channel(type));
  if (tiled) header.setTileDescription(Imf::TileDescription(4, 4, Imf::MIPMAP_LEVELS));
  std::vector<char> pixels(static_cast<std::size_t>(width * height) * 4, 0x35);
  const std::size_t size = type == Imf::HALF ? 2 : 4;
  Imf::FrameBuffer frame;
  for (const auto& name : channels) frame.insert(name, Imf::Slice(type, pixels.data(), size, size * width));
  const std::string path = (scratch() / "seed.exr").string();
  if (tiled) {
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    for (int level = 0; level < file.numLevels(); ++level)
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  } else {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  return file_bytes(path);
}

/// Two parts of scanlines: colour, and depth in a smaller window.
Bytes parts() {
  std::vector<Imf::Header> headers(2, Imf::Header(width, height));
  headers[1].dataWindow() = Imath::Box2i({1, 2}, {4, 5});
  std::vector<std::vector<std::string>> channels = {{"R", "G", "B"}, {"Z"}};
  std::vector<char> pixels(static_cast<std::size_t>(width * height) * 4, 0x35);
  for (std::size_t p = 0; p < headers.size(); ++p) {
    headers[p].setName(p == 0 ? "colour" : "depth");
    headers[p].setType(Imf::SCANLINEIMAGE);
    for (const auto& name : channels[p]) headers[p].channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  const std::string path = (scratch() / "seed.exr").string();
  {
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
    for (int p = 0; p < 2; ++p) {
      const Imath::Box2i& window = headers[static_cast<std::size_t>(p)].dataWindow();
      Imf::FrameBuffer frame;
      for (const auto& name : channels[static_cast<std::size_t>(p)])
        frame.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels.data(), window));
      Imf::OutputPart part(file, p);
      part.setFrameBuffer(frame);
      part.writePixels(window.max.y - window.min.y + 1);
    }
  }
  return file_bytes(path);
}

Limits small() {
  Limits limits;
  limits.side = 4096, limits.pixels = 1 << 18, limits.channels = 64, limits.memory = 24 << 20;
  return limits;
}

void read_all(PixelSource& source) {
  for (std::size_t i = 0; i < source.subimages().size() && i < 8; ++i) {
    const Subimage& picture = source.subimages()[i];
    expect(picture.data.width() > 0 && picture.data.height() > 0);
    source.attributes(i);
    if (!picture.readable) continue;
    try {
      source.colour(i, "");
    } catch (const Error&) {  // several candidates: the user has to say which
    }
    const int rows = band_rows(picture);
    expect(rows > 0);
    Band band;
    for (int y = picture.data.y0; y < picture.data.y1; y += rows)
      source.read(i, y, std::min(rows, picture.data.y1 - y), band);
  }
}

}  // namespace

std::vector<Bytes> seeds() {
  Imf::setGlobalThreadCount(0);
  const std::vector<std::string> rgb = {"R", "G", "B", "A"},
                                 bands = {"S0.400,0nm", "S0.500,0nm", "S0.600,0nm"};
  return {file_of(rgb, Imf::NO_COMPRESSION, Imf::HALF, false),
          file_of(rgb, Imf::ZIP_COMPRESSION, Imf::FLOAT, false),
          file_of(rgb, Imf::PIZ_COMPRESSION, Imf::HALF, true),
          file_of(rgb, Imf::RLE_COMPRESSION, Imf::UINT, true),
          file_of(bands, Imf::ZIPS_COMPRESSION, Imf::FLOAT, false),
          file_of(bands, Imf::DWAA_COMPRESSION, Imf::HALF, false),
          file_of({"L", "M", "S", "R"}, Imf::B44_COMPRESSION, Imf::HALF, false),
          file_of({"Y"}, Imf::PXR24_COMPRESSION, Imf::FLOAT, false),
          parts()};
}

}  // namespace scotopic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scotopic;
  const std::string file = fuzz::scratch_file("input.exr", data, size);
  try {
    fuzz::read_all(*open_exr_source(file, fuzz::small()));
  } catch (const Error&) {
  }
  try {
    if (auto source = open_spectral_source(file, {}, fuzz::small())) fuzz::read_all(*source);
  } catch (const Error&) {
  }
  return 0;
}

#include "support/exr_files.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <OpenEXR/ImfTimeCodeAttribute.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/exr/exr_source.h"

namespace scotopic::test {
namespace {

/// Mixes 64 bits (Steele et al. 2014, SplitMix64).
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

Band filled(const TestPart& part, const Window& window) {
  Band band;
  band.allocate_planar(part.channels, window.y0, window.height(), window.width());
  for (std::size_t c = 0; c < part.channels.size(); ++c)
    for (int y = 0; y < window.height(); ++y)
      for (int x = 0; x < window.width(); ++x) {
        const std::uint32_t bits = pixel_bits(part, c, window.x0 + x, window.y0 + y);
        const auto half_bits = static_cast<std::uint16_t>(bits);
        std::byte* at = band.channels[c].data + y * band.channels[c].row_stride + x * band.channels[c].stride;
        if (part.channels[c].type == PixelType::half)
          std::memcpy(at, &half_bits, 2);
        else
          std::memcpy(at, &bits, 4);
      }
  return band;
}

Imf::Header header_of(const TestPart& part, bool several) {
  Imf::Header header(
      Imath::Box2i({part.display.x0, part.display.y0}, {part.display.x1 - 1, part.display.y1 - 1}),
      Imath::Box2i({part.data.x0, part.data.y0}, {part.data.x1 - 1, part.data.y1 - 1}));
  header.compression() = part.compression;
  header.lineOrder() = part.order;
  for (const Channel& channel : part.channels)
    header.channels().insert(channel.name, Imf::Channel(exr_type(channel.type), 1, 1, channel.name == "id"));
  if (part.tiles) header.setTileDescription(*part.tiles);
  header.setType(part.tiles ? Imf::TILEDIMAGE : Imf::SCANLINEIMAGE);
  if (several) header.setName(part.name);
  header.insert("studio", Imf::StringVectorAttribute(Imf::StringVector{"night", "shift"}));
  header.insert("camera", Imf::M44fAttribute(Imath::M44f(2.0f)));
  header.insert("when", Imf::TimeCodeAttribute(Imf::TimeCode(1, 2, 3, 4)));
  header.insert("gain", Imf::FloatAttribute(0.1f));
  return header;
}

}  // namespace

std::uint32_t pixel_bits(const TestPart& part, std::size_t channel, int x, int y) {
  const std::uint64_t place =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
  const std::uint64_t random = mixed(place ^ mixed(channel));
  const PixelType type = part.channels[channel].type;
  if (!part.finite || type == PixelType::uint32) return static_cast<std::uint32_t>(random);
  const auto value =
      static_cast<float>(std::pow(10.0, -3.0 + 4.0 * static_cast<double>(random >> 11) * 0x1p-53));
  return type == PixelType::half ? Imath::half(value).bits() : std::bit_cast<std::uint32_t>(value);
}

void write_exr(const std::string& file, const std::vector<TestPart>& parts) {
  std::vector<Imf::Header> headers;
  for (const TestPart& part : parts) headers.push_back(header_of(part, parts.size() > 1));
  Imf::MultiPartOutputFile out(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (int p = 0; p < static_cast<int>(parts.size()); ++p) {
    const TestPart& part = parts[static_cast<std::size_t>(p)];
    if (!part.tiles) {
      const Band band = filled(part, part.data);
      Imf::OutputPart scanlines(out, p);
      scanlines.setFrameBuffer(frame_buffer(part.channels, band, part.data.x0));
      scanlines.writePixels(part.data.height());
      continue;
    }
    Imf::TiledOutputPart tiles(out, p);
    for (int ly = 0; ly < tiles.numYLevels(); ++ly)
      for (int lx = 0; lx < tiles.numXLevels(); ++lx) {
        if (part.tiles->mode != Imf::RIPMAP_LEVELS && lx != ly) continue;
        const Window window =
            level_window(headers[static_cast<std::size_t>(p)], tiles.levelWidth(lx), tiles.levelHeight(ly));
        const Band band = filled(part, window);
        tiles.setFrameBuffer(frame_buffer(part.channels, band, window.x0));
        tiles.writeTiles(0, tiles.numXTiles(lx) - 1, 0, tiles.numYTiles(ly) - 1, lx, ly);
      }
  }
}

std::vector<std::uint32_t> read_bits(const std::string& file, int part, int level_x, int level_y,
                                     const std::string& channel) {
  ExrSource source(file, Limits());
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < source.subimages().size(); ++i) {
    const Subimage& picture = source.subimages()[i];
    if (picture.part != part || picture.level_x != level_x || picture.level_y != level_y) continue;
    Band band;
    source.read(i, picture.data.y0, picture.data.height(), band);
    for (std::size_t c = 0; c < picture.channels.size(); ++c) {
      if (picture.channels[c].name != channel) continue;
      for (int y = 0; y < band.rows; ++y)
        for (int x = 0; x < band.width; ++x) {
          const NativeRow row = band.channels[c].row(y);
          std::uint32_t bits = 0;
          std::memcpy(&bits, row.data + x * row.stride, size_of(row.type));
          out.push_back(bits);
        }
    }
  }
  return out;
}

std::string temporary(const std::string& name) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) /
                                       ("scotopic-image-" + std::to_string(getpid())) / test->name();
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

std::string file_bytes(const std::string& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

ImageLayout run_operator(const std::string& in, const std::string& out, double adaptation,
                         const ImageRequest& request) {
  const ColourConfig config = ColourConfig::own();
  OutputFile file(out);
  const std::unique_ptr<PixelSource> source = open_source(in, Limits());
  ImageLayout layout = plan_layout(*source, out, config, request);
  AppearanceParameters parameters;
  parameters.adaptation = adaptation;
  parameters.white_luminance = 1;
  parameters.xyz_from_rgb = config.xyz_from_working();
  parameters.xyz_from_gamut = config.xyz_from_working();
  set_stamps(layout, {{"scotopic:adaptation", adaptation}, {"whiteLuminance", 1.0}});
  const Evaluator evaluator("float", parameters, Precision::single);
  ImageStages stages;
  stages.evaluator = &evaluator;
  apply_image(*source, layout, config, stages, file);
  return layout;
}

}  // namespace scotopic::test

#include "io/exr/exr_source.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTileDescription.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>

#include "base/error.h"
#include "io/exr/exr_headers.h"
#include "io/exr/exr_tags.h"
#include "io/exr/open_exr.h"

namespace scotopic {
namespace {

bool is_deep(const Imf::Header& header) {
  return header.hasType() && (header.type() == Imf::DEEPSCANLINE || header.type() == Imf::DEEPTILE);
}

/// Chroma at half the columns and rows, and no R, G, B beside it.
bool is_luminance_chroma(const Imf::Header& header) {
  const Imf::ChannelList& channels = header.channels();
  const auto is_halved = [&](const char* name) {
    const Imf::Channel* const found = channels.findChannel(name);
    return found && found->xSampling == 2 && found->ySampling == 2;
  };
  return !is_deep(header) && !channels.findChannel("R") && channels.findChannel("Y") && is_halved("RY") &&
         is_halved("BY");
}

bool is_tiled(const Imf::Header& header) { return header.hasTileDescription(); }

}  // namespace

Window window_of(const Imath::Box2i& box) {
  // 64 bits first: a hostile header may hold the extremes of int.
  const auto after = [](int last) {
    return static_cast<int>(std::min<std::int64_t>(std::int64_t{last} + 1, INT32_MAX));
  };
  return {box.min.x, box.min.y, after(box.max.x), after(box.max.y)};
}

int rows_compressed_together(const Imf::Header& header) {
  return header.hasTileDescription() ? static_cast<int>(header.tileDescription().ySize)
                                     : rows_compressed_together(header.compression());
}

int rows_compressed_together(int compression) {
  switch (compression) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    case htj2k32:
      return 32;
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    default:  // HTJ2K in 256s, and whatever comes after it: the most that any takes
      return 256;
  }
}

PixelType pixel_type(Imf::PixelType type) {
  return type == Imf::HALF ? PixelType::half : type == Imf::FLOAT ? PixelType::float32 : PixelType::uint32;
}

Imf::PixelType exr_type(PixelType type) {
  return type == PixelType::half ? Imf::HALF : type == PixelType::float32 ? Imf::FLOAT : Imf::UINT;
}

Window level_window(const Imf::Header& header, int width, int height) {
  const Imath::Box2i& box = header.dataWindow();
  return {box.min.x, box.min.y, box.min.x + width, box.min.y + height};
}

Imf::FrameBuffer frame_buffer(const std::vector<Channel>& channels, const Band& band, int x0) {
  Imf::FrameBuffer frame;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const ChannelRows& rows = band.channels[i];
    // OpenEXR addresses from the origin, which may lie outside the buffer; integers may, pointers may not.
    const auto origin = reinterpret_cast<std::intptr_t>(rows.data) -
                        std::intptr_t{band.y0} * rows.row_stride - std::intptr_t{x0} * rows.stride;
    frame.insert(channels[i].name.c_str(), Imf::Slice(exr_type(rows.type), reinterpret_cast<char*>(origin),
                                                      static_cast<std::size_t>(rows.stride),
                                                      static_cast<std::size_t>(rows.row_stride)));
  }
  return frame;
}

ExrSource::ExrSource(const std::string& file, const Limits& limits) : PixelSource(file, "openexr") {
  try {
    watch(file);
    check_exr_headers(file, limits);
    const auto side = static_cast<int>(std::min<std::int64_t>(limits.side, INT32_MAX));
    Imf::Header::setMaxImageSize(side, side);
    Imf::Header::setMaxTileSize(side, side);
    exr_ = open_exr(file);
    for (int part = 0; part < exr_->parts(); ++part) {
      add_subimages(part);
      check_limits(limits);
      if (!exr_->partComplete(part)) fail("is truncated: it was not written to its end");
    }
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    fail(std::string("is not a valid OpenEXR file: ") + e.what());
  }
}

void ExrSource::add_subimages(int part) {
  const Imf::Header& header = exr_->header(part);
  Subimage subimage;
  subimage.part = part;
  subimage.name = header.hasName() ? header.name() : "";
  subimage.pixel_aspect = usable_aspect(static_cast<double>(header.pixelAspectRatio()));
  subimage.view = header.hasView() ? header.view() : "";
  if (Imf::hasMultiView(header)) subimage.views = Imf::multiView(header);
  subimage.data = window_of(header.dataWindow());
  subimage.display = window_of(header.displayWindow());
  subimage.readable = !is_deep(header);
  subimage.colour = colour_tags(header, exr_->header(0));
  subimage.white_luminance = number_attribute(header, "whiteLuminance");
  subimage.lmsr_unit = number_attribute(header, "scotopic:lmsrUnit");
  subimage.notes = mistyped_attributes(header);
  subimage.chunk_rows = rows_compressed_together(header);
  subimage.descending = header.lineOrder() == Imf::DECREASING_Y;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    subimage.channels.push_back({it.name(), pixel_type(it.channel().type)});
    if (it.channel().xSampling != 1 || it.channel().ySampling != 1) subimage.readable = false;
  }
  if (is_luminance_chroma(header) && exr_->parts() == 1) return add_luminance_chroma(subimage);
  if (!is_tiled(header) || !subimage.readable) {
    subimages_.push_back(subimage);
    return;
  }
  const Imf::TileDescription& tiles = header.tileDescription();
  subimage.chunk_rows = static_cast<int>(tiles.ySize);
  auto& tiled = tiled_[part] = std::make_unique<Imf::TiledInputPart>(*exr_, part);
  const bool ripmap = tiles.mode == Imf::RIPMAP_LEVELS;
  for (int ly = 0; ly < tiled->numYLevels(); ++ly) {
    for (int lx = 0; lx < (ripmap ? tiled->numXLevels() : 1); ++lx) {
      subimage.level_x = ripmap ? lx : ly;
      subimage.level_y = ly;
      subimage.data = level_window(header, tiled->levelWidth(subimage.level_x), tiled->levelHeight(ly));
      subimages_.push_back(subimage);
    }
  }
}

/// Colour that is stored as luminance and subsampled chroma: OpenEXR itself makes R, G, B of it, in half.
void ExrSource::add_luminance_chroma(Subimage subimage) {
  rgba_ = std::make_unique<Imf::RgbaInputFile>(file().c_str());
  subimage.readable = true;
  subimage.chunk_rows = 1;
  subimage.channels.clear();
  for (const char* name : {"R", "G", "B"}) subimage.channels.push_back({name, PixelType::half});
  if ((rgba_->channels() & Imf::WRITE_A) != 0) subimage.channels.push_back({"A", PixelType::half});
  subimage.notes.push_back(
      "luminance and chroma (Y, RY, BY) become R, G, B of half; its other channels are left out");
  subimages_.push_back(subimage);
}

void ExrSource::read_luminance_chroma(const Subimage& subimage, int y0, int rows, Band& band) {
  const auto width = static_cast<std::size_t>(subimage.data.width());
  std::vector<Imf::Rgba> pixels(width * static_cast<std::size_t>(rows));
  rgba_->setFrameBuffer(
      pixels.data() - subimage.data.x0 - static_cast<std::ptrdiff_t>(y0) * subimage.data.width(), 1, width);
  rgba_->readPixels(y0, y0 + rows - 1);
  for (std::size_t c = 0; c < subimage.channels.size(); ++c)
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Imath::half values[4] = {pixels[i].r, pixels[i].g, pixels[i].b, pixels[i].a};
      std::memcpy(band.channels[c].data + 2 * i, &values[c], 2);
    }
}

void ExrSource::read_scanlines(const Subimage& subimage, const Imf::FrameBuffer& frame, int y0, int rows) {
  Imf::InputPart part(*exr_, subimage.part);
  part.setFrameBuffer(frame);
  part.readPixels(y0, y0 + rows - 1);
}

void ExrSource::read_tiles(const Subimage& subimage, const Imf::FrameBuffer& frame, int y0, int rows) {
  Imf::TiledInputPart& part = *tiled_.at(subimage.part);
  part.setFrameBuffer(frame);
  const int first = (y0 - subimage.data.y0) / subimage.chunk_rows;
  const int last = (y0 + rows - 1 - subimage.data.y0) / subimage.chunk_rows;
  part.readTiles(0, part.numXTiles(subimage.level_x) - 1, first, last, subimage.level_x, subimage.level_y);
}

void ExrSource::read(std::size_t index, int y0, int rows, Band& band) {
  const Subimage& subimage = subimages_[index];
  band.allocate_planar(subimage.channels, y0, rows, subimage.data.width());
  try {
    if (rgba_) return read_luminance_chroma(subimage, y0, rows, band);
    const Imf::FrameBuffer frame = frame_buffer(subimage.channels, band, subimage.data.x0);
    if (tiled_.count(subimage.part))
      read_tiles(subimage, frame, y0, rows);
    else
      read_scanlines(subimage, frame, y0, rows);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    fail(std::string("is truncated or damaged: ") + e.what());
  }
}

std::vector<Attribute> ExrSource::attributes(std::size_t index) const {
  std::vector<Attribute> out;
  const Imf::Header& header = exr_->header(subimages_[index].part);
  for (auto it = header.begin(); it != header.end(); ++it) {
    const Imf::Attribute& attribute = it.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
      out.push_back({it.name(), text->value()});
    } else if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) {
      out.push_back({it.name(), static_cast<double>(number->value())});
    } else if (const auto* integer = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
      out.push_back({it.name(), integer->value()});
    } else if (const auto* envmap = dynamic_cast<const Imf::EnvmapAttribute*>(&attribute)) {
      out.push_back({it.name(), std::string(envmap->value() == Imf::ENVMAP_LATLONG ? "latlong" : "cube")});
    }
  }
  return out;
}

std::unique_ptr<PixelSource> open_exr_source(const std::string& file, const Limits& limits) {
  return std::make_unique<ExrSource>(file, limits);
}

}  // namespace scotopic

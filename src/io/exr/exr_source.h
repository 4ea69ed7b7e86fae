// OpenEXR files through its own library: every attribute, type, window, tile and part as it is in the file.
#pragma once

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPixelType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTiledInputPart.h>

#include <map>

#include "io/pixel_source.h"

namespace scotopic {

/// A subimage for each part and resolution; scanlines or tiles.
class ExrSource : public PixelSource {
 public:
  /// Reads the headers. Throws Error(input) or Error(limit).
  ExrSource(const std::string& file, const Limits& limits);

  void read(std::size_t index, int y0, int rows, Band& band) override;
  std::vector<Attribute> attributes(std::size_t index) const override;

  /// The open file, for what a sink copies from it.
  Imf::MultiPartInputFile& exr() { return *exr_; }
  /// Header of a part.
  const Imf::Header& header(int part) const { return exr_->header(part); }
  /// Number of parts.
  int parts() const { return exr_->parts(); }

 private:
  void add_subimages(int part);
  void add_luminance_chroma(Subimage subimage);
  void read_luminance_chroma(const Subimage& subimage, int y0, int rows, Band& band);
  void read_scanlines(const Subimage& subimage, const Imf::FrameBuffer& frame, int y0, int rows);
  void read_tiles(const Subimage& subimage, const Imf::FrameBuffer& frame, int y0, int rows);

  std::unique_ptr<Imf::MultiPartInputFile> exr_;
  std::unique_ptr<Imf::RgbaInputFile> rgba_;  // of luminance and chroma
  // Kept between bands: it caches the tile row it reads.
  std::map<int, std::unique_ptr<Imf::TiledInputPart>> tiled_;
};

/// Rows that are decompressed at once: of a chunk of scanlines, or of a tile.
int rows_compressed_together(const Imf::Header& header);
/// HTJ2K, of OpenEXR 3.4, by number: the headers of those before have no name for it.
inline constexpr int htj2k256 = 10, htj2k32 = 11;
/// Of scanlines; 256, the most, for a compression that nobody here knows.
int rows_compressed_together(int compression);

/// The file's channel type; uint is uint32.
PixelType pixel_type(Imf::PixelType type);
/// And back; no integer type but uint32.
Imf::PixelType exr_type(PixelType type);

/// Clamped where an extreme of int stands in a hostile header.
Window window_of(const Imath::Box2i& box);
/// The window of one resolution of a part.
Window level_window(const Imf::Header& header, int width, int height);

/// Rows of a band as OpenEXR wants them: origin at pixel (0, 0) of the data window's coordinates.
Imf::FrameBuffer frame_buffer(const std::vector<Channel>& channels, const Band& band, int x0);

}  // namespace scotopic

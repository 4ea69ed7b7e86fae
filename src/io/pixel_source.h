// Where pixels come from: any number of subimages, read in bands, so that memory does not grow with the
// height.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "base/limits.h"
#include "io/light_channels.h"
#include "io/subimage.h"

namespace scotopic {

/// A file being read. Errors are Error(ExitCode::input) with the file's name. One thread at a time.
class PixelSource {
 public:
  virtual ~PixelSource() = default;

  /// As it was named.
  const std::string& file() const noexcept { return file_; }
  /// openexr, tiff, png, hdr, jpeg.
  const std::string& format() const noexcept { return format_; }
  /// All of them, in the file's order; known once it is open.
  const std::vector<Subimage>& subimages() const noexcept { return subimages_; }

  /// Rows y0 <= y < y0 + rows of subimage `index` (rows in steps of chunk_rows from data.y0, or to the end).
  virtual void read(std::size_t index, int y0, int rows, Band& band) = 0;
  /// Where the light of a subimage is; see find_colour().
  virtual ColourChannels colour(std::size_t index, const std::string& layer) const {
    return find_colour(subimages_[index], layer, file_);
  }
  /// What other formats can hold of a subimage's metadata.
  virtual std::vector<Attribute> attributes(std::size_t index) const = 0;
  /// Throws if a file has changed since it was opened: before what was made of it takes its place.
  void require_unchanged() const;

 protected:
  /// Sources set pictures_ themselves.
  PixelSource(std::string file, std::string format) : file_(std::move(file)), format_(std::move(format)) {}
  /// Throws Error(input) about this file.
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws for the first limit that a subimage exceeds.
  void check_limits(const Limits& limits) const;
  /// To be called before a file is opened.
  void watch(const std::string& file) { watched_.emplace_back(file); }

  std::vector<Subimage> subimages_;

 private:
  std::string file_;
  std::string format_;
  std::vector<FileState> watched_;
};

/// Opens by content, not by name: OpenEXR (scanlines, tiles, parts), TIFF, PNG, JPEG, Radiance HDR; anything
/// else is refused. The pixels are not looked at.
std::unique_ptr<PixelSource> open_source(const std::string& file, const Limits& limits);

/// OpenEXR; see open_source().
std::unique_ptr<PixelSource> open_exr_source(const std::string& file, const Limits& limits);

}  // namespace scotopic

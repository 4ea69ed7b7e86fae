// Where pixels go: an OpenEXR, TIFF, PNG or JPEG file that appears when it is committed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "color/file/written_tags.h"
#include "io/atomic/output_file.h"
#include "io/pixel_source.h"

namespace scotopic {

/// How one subimage of the source is written.
struct OutputSubimage {
  std::size_t source = 0;  ///< index of the subimage it is made from
  Subimage subimage;       ///< with the channels it will have
  bool copy = false;       ///< compressed chunks as they are (OpenEXR to OpenEXR)
  /// Set over whatever the source says: what was applied.
  std::vector<Attribute> stamps;
  /// Colour values changed their space.
  bool new_space = false;
  /// What the source's header states of its colours does not hold for the output: `tags` do.
  bool new_tags = false;
  WrittenTags tags;
  bool for_a_device = false;  ///< values are what a device is sent: no cd/m2 belong to them any more
  int jpeg_quality = 95;      ///< 1 to 100
};

/// Errors are Error(ExitCode::output). One thread at a time.
class PixelSink {
 public:
  virtual ~PixelSink() = default;
  /// Whether write() wants the channels of a pixel side by side, all of one type.
  virtual bool interleaved() const = 0;
  /// Rows of output subimage `index`, channels in its order; bands in the order of the source's.
  virtual void write(std::size_t index, const Band& band) = 0;
  /// An output subimage with `copy` set, all of it.
  virtual void copy(std::size_t index) = 0;
  /// Ends the file. It is complete then, and its OutputFile is to be committed.
  virtual void finish() = 0;
};

/// openexr, tiff, png or jpeg by the name's extension; Error(usage) for any other.
std::string output_format(const std::string& path);

/// Types of colour channels that the format can hold.
const std::vector<PixelType>& pixel_types_of(const std::string& format);

/// OpenEXR: header, tiles, order of lines and compression of the source (ZIP in place of a lossy one).
/// `source` and `file` must outlive the sink. TIFF: one page for each subimage; PNG and JPEG: exactly one
/// subimage.
std::unique_ptr<PixelSink> open_sink(const std::string& format, OutputFile& file, PixelSource& source,
                                     const std::vector<OutputSubimage>& subimages);

/// OpenEXR; see open_sink().
std::unique_ptr<PixelSink> open_exr_sink(OutputFile& file, PixelSource& source,
                                         const std::vector<OutputSubimage>& subimages);

}  // namespace scotopic

// The OpenEXR files that hold one spectral picture: one, or one for each wavelength.
#pragma once

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/limits.h"

namespace scotopic {

/// A channel somewhere in the files.
struct ChannelPlace {
  std::size_t file;
  int part;
  std::string channel;
  Imf::PixelType type;
};

/// Where a channel's pixels go.
struct ChannelTarget {
  const ChannelPlace* place;
  Imf::Slice slice;
};

class SpectralFiles {
 public:
  /// Opens one more. Throws Error(input) or Error(limit).
  void add(const std::string& name, const Limits& limits);

  /// Every whole channel of every file, deep parts aside.
  const std::vector<ChannelPlace>& channels() const noexcept { return channels_; }
  const Imf::Header& header_of(const ChannelPlace& place) const {
    return files_[place.file]->header(place.part);
  }
  /// Headers of the first file's parts.
  std::vector<const Imf::Header*> headers() const;
  /// Of the file added last; empty where there is none.
  std::string last_name() const { return names_.empty() ? std::string() : names_.back(); }

  /// Reads rows y0 to y0 + rows of these channels. Throws Error(input) for what is damaged.
  void read(int y0, int rows, const std::vector<ChannelTarget>& targets);

 private:
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<Imf::MultiPartInputFile>> files_;
  std::vector<ChannelPlace> channels_;
};

/// What a library says, up to its first line's end, without the full stop.
std::string one_line(const std::string& text);

}  // namespace scotopic

// An image in memory as a source and a sink of the pipeline. It goes by the rules of an OpenEXR file with the
// same channels: bytes come out as from file to file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/pixel_sink.h"
#include "io/pixel_source.h"
#include "pipeline/memory/memory_pixels.h"

namespace scotopic {

/// Where an image in memory lies in its frame, and what its header would say.
struct MemoryHeader {
  std::string name = "image";  ///< for messages
  Window data;                 ///< the pixels that are there
  Window display;              ///< the whole frame
  /// Of a tile: where all pixels of its image lie. Those of the tile whose halo it holds become what they
  /// would be in the image.
  std::optional<Window> whole;
  bool straight = false;  ///< colour is not multiplied by alpha
  double pixel_aspect = 1;
};

/// Reads where the pixels are: no copy is made, but of double.
class MemorySource : public PixelSource {
 public:
  MemorySource(const MemoryPixels& pixels, const MemoryHeader& header);
  void read(std::size_t index, int y0, int rows, Band& band) override;
  std::vector<Attribute> attributes(std::size_t index) const override;

 private:
  MemoryPixels pixels_;
};

/// Writes those pixels that lie in `window`, which is `to`. Samples of double whose value has not changed in
/// float keep all their digits.
class MemorySink : public PixelSink {
 public:
  /// `from` is what MemorySource reads, at `data`.
  MemorySink(const MemoryPixels& from, const Window& data, const MemoryPixels& to, const Window& window)
      : from_(from), data_(data), to_(to), window_(window) {}
  bool interleaved() const override { return false; }
  void write(std::size_t index, const Band& band) override;
  void copy(std::size_t index) override;
  void finish() override {}

 private:
  void write_row(const Band& band, int y, int x0, int count, int channel) const;

  MemoryPixels from_;
  Window data_;
  MemoryPixels to_;
  Window window_;
};

}  // namespace scotopic

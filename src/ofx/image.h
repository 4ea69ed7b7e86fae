// An image of a host, for as long as it is needed, as pixels in memory. Hosts count rows from below, the
// pipeline from above.
#pragma once

#include "ofx/api.h"
#include "ofx/suites.h"
#include "pipeline/memory/memory_source.h"

namespace scotopic::ofx {

/// Fetched from a clip at a time; given back when it goes.
class Image {
 public:
  /// Error(input) where there is none, or one of a kind that the plug-in did not ask for.
  Image(Clip clip, Time time);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  /// The pixels that are there, in the host's coordinates.
  const RectI& bounds() const noexcept { return bounds_; }
  /// The whole frame.
  const RectI& frame() const noexcept { return frame_; }
  /// Those of `window`, which lies inside the bounds.
  MemoryPixels pixels(const RectI& window) const;
  /// Colour is not multiplied by alpha.
  bool straight() const;
  double pixel_aspect() const;

 private:
  PropertySet set_ = nullptr;
  RectI bounds_{};
  RectI frame_{};
  std::byte* data_ = nullptr;
  std::ptrdiff_t row_bytes_ = 0;
  int channels_ = 4;
  SampleType type_ = SampleType::float32;
};

/// Upside down: in a frame, from above.
Window window_in(const RectI& window, const RectI& frame);
/// By so many pixels on each side.
RectI grown(const RectI& window, int by);
bool holds(const RectI& a, const RectI& b);
/// What both hold; empty where they do not meet.
RectI common(const RectI& a, const RectI& b);

}  // namespace scotopic::ofx

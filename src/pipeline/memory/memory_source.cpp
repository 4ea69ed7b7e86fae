#include "pipeline/memory/memory_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "io/pixels/copy_pixels.h"

namespace scotopic {
namespace {

constexpr const char* names[] = {"R", "G", "B", "A"};

PixelType type_in_bands(SampleType type) {
  return type == SampleType::half ? PixelType::half : PixelType::float32;
}

double load_double(const std::byte* at) {
  double value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// Beyond float's range is infinity, as everywhere.
float to_float(double value) {
  constexpr double greatest = 0x1.ffffffp127;  // from here on values round to infinity
  if (value >= greatest) return HUGE_VALF;
  if (value <= -greatest) return -HUGE_VALF;
  return static_cast<float>(value);
}

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

MemorySource::MemorySource(const MemoryPixels& pixels, const MemoryHeader& header)
    : PixelSource(header.name, "openexr"), pixels_(pixels) {
  Subimage subimage;
  subimage.data = header.data;
  subimage.display = header.display;
  subimage.pixel_aspect = usable_aspect(header.pixel_aspect);
  subimage.unassociated_alpha = header.straight && pixels.channels == 4;
  for (int c = 0; c < pixels.channels; ++c)
    subimage.channels.push_back({names[c], type_in_bands(pixels.type)});
  subimages_.push_back(subimage);
  if (pixels.width <= 0 || pixels.height <= 0) fail("has no pixels");
}

void MemorySource::read(std::size_t, int y0, int rows, Band& band) {
  const Subimage& subimage = subimages_.front();
  const int first = y0 - subimage.data.y0;
  if (pixels_.type != SampleType::float64) {
    band = Band();
    band.y0 = y0;
    band.rows = rows;
    band.width = pixels_.width;
    for (int c = 0; c < pixels_.channels; ++c)
      band.channels.push_back(
          {pixels_.at(0, first, c), pixels_.pixel_stride, pixels_.row_stride, type_in_bands(pixels_.type)});
    return;
  }
  band.allocate_planar(subimage.channels, y0, rows, pixels_.width);
  for (int c = 0; c < pixels_.channels; ++c)
    for (int y = 0; y < rows; ++y) {
      std::byte* to = band.channels[static_cast<std::size_t>(c)].row(y).data;
      for (int x = 0; x < pixels_.width; ++x, to += sizeof(float)) {
        const float value = to_float(load_double(pixels_.at(x, first + y, c)));
        std::memcpy(to, &value, sizeof value);
      }
    }
}

std::vector<Attribute> MemorySource::attributes(std::size_t) const { return {}; }

void MemorySink::write(std::size_t, const Band& band) {
  const int x0 = std::max(window_.x0, data_.x0), x1 = std::min(window_.x1, data_.x1);
  if (x1 <= x0) return;
  const int y0 = std::max(window_.y0, band.y0), y1 = std::min(window_.y1, band.y0 + band.rows);
  for (int y = y0; y < y1; ++y)
    for (int c = 0; c < to_.channels; ++c) write_row(band, y, x0, x1 - x0, c);
}

void MemorySink::write_row(const Band& band, int y, int x0, int count, int channel) const {
  NativeRow from = band.channels[static_cast<std::size_t>(channel)].row(y - band.y0);
  from.data += (x0 - data_.x0) * from.stride;
  std::byte* to = to_.at(x0 - window_.x0, y - window_.y0, channel);
  if (to_.type != SampleType::float64)
    return copy_pixels(from, static_cast<std::size_t>(count), {to, to_.pixel_stride, from.type});
  const std::byte* was = from_.at(x0 - data_.x0, y - data_.y0, channel);
  for (int x = 0; x < count; ++x) {
    float value;
    std::memcpy(&value, from.data + x * from.stride, sizeof value);
    const double before = load_double(was + x * from_.pixel_stride);
    const double after = same_bits(value, to_float(before)) ? before : static_cast<double>(value);
    std::memcpy(to + x * to_.pixel_stride, &after, sizeof after);
  }
}

void MemorySink::copy(std::size_t) {
  throw Error(ExitCode::internal, "", "an image in memory has no compressed chunks");
}

}  // namespace scotopic

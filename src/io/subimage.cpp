#include "io/subimage.h"

#include <algorithm>

namespace scotopic {
namespace {

constexpr std::size_t band_bytes = std::size_t{8} << 20;

}  // namespace

bool ColourChannels::is_colour(std::size_t channel) const {
  return std::find(index.begin(), index.begin() + static_cast<std::ptrdiff_t>(count()), channel) !=
         index.begin() + static_cast<std::ptrdiff_t>(count());
}

void Band::allocate_planar(const std::vector<Channel>& types, int first_row, int row_count, int row_width) {
  y0 = first_row;
  rows = row_count;
  width = row_width;
  std::size_t total = 0;
  const auto pixels = static_cast<std::size_t>(row_count) * static_cast<std::size_t>(row_width);
  for (const Channel& channel : types) total += pixels * size_of(channel.type);
  storage.resize(total);
  channels.clear();
  std::byte* at = storage.data();
  for (const Channel& channel : types) {
    const auto size = static_cast<std::ptrdiff_t>(size_of(channel.type));
    channels.push_back({at, size, size * row_width, channel.type});
    at += pixels * size_of(channel.type);
  }
}

void Band::allocate_interleaved(const std::vector<Channel>& types, int first_row, int row_count,
                                int row_width) {
  y0 = first_row;
  rows = row_count;
  width = row_width;
  std::size_t pixel = 0;
  for (const Channel& channel : types) pixel += size_of(channel.type);
  storage.resize(pixel * static_cast<std::size_t>(row_count) * static_cast<std::size_t>(row_width));
  channels.clear();
  std::byte* at = storage.data();
  const auto stride = static_cast<std::ptrdiff_t>(pixel);
  for (const Channel& channel : types) {
    channels.push_back({at, stride, stride * row_width, channel.type});
    at += size_of(channel.type);
  }
}

std::size_t row_bytes(const Subimage& subimage) {
  std::size_t pixel = subimage.computed_bytes;
  for (const Channel& channel : subimage.channels) pixel += size_of(channel.type);
  return pixel * static_cast<std::size_t>(subimage.data.width());
}

int band_rows(const Subimage& subimage) {
  const std::size_t chunk =
      std::max<std::size_t>(1, row_bytes(subimage) * static_cast<std::size_t>(subimage.chunk_rows));
  const auto chunks = static_cast<int>(std::clamp<std::size_t>(band_bytes / chunk, 1, 1024));
  const std::int64_t rows = std::int64_t{chunks} * subimage.chunk_rows;
  return static_cast<int>(std::min<std::int64_t>(rows, std::max(1, subimage.data.height())));
}

std::int64_t planned_bytes(const Subimage& subimage) {
  constexpr std::int64_t bands = 3;
  return bands * static_cast<std::int64_t>(row_bytes(subimage)) * band_rows(subimage) +
         subimage.library_bytes;
}

}  // namespace scotopic
